#include "system/contact_state.h"

#include <cassert>

namespace subimpact {

std::span<const EventKind> event_kinds(ContactBranch branch) {
  static constexpr EventKind separated[] = {EventKind::contact_begins};
  static constexpr EventKind elastic[] = {EventKind::contact_ends, EventKind::contact_yields};
  static constexpr EventKind plastic[] = {EventKind::contact_unloads};
  switch (branch) {
    case ContactBranch::separated:
      return separated;
    case ContactBranch::elastic:
      return elastic;
    case ContactBranch::plastic:
      return plastic;
  }
  return {};
}

double ContactState::force(double indentation) const {
  if (evaluation_ == Evaluation::switching) return law_->force(history_, indentation);
  return law_->branch_force(branch_, history_, indentation);
}

double ContactState::slope(double indentation) const {
  const ContactBranch branch =
      evaluation_ == Evaluation::switching ? law_->branch(history_, indentation) : branch_;
  return law_->branch_slope(branch, history_, indentation);
}

ContactState::Energies ContactState::energies(double indentation) const {
  const ContactHistory reached = loads() ? ContactLaw::commit(history_, indentation) : history_;
  return {is_closed() ? law_->recoverable_energy(reached, indentation) : 0.0,
          law_->dissipated_energy(reached)};
}

EventValue ContactState::event_function(EventKind kind, double indentation, double rate) const {
  switch (kind) {
    case EventKind::contact_begins:
      return {indentation - residual_indentation(), rate};
    case EventKind::contact_ends:
      return {residual_indentation() - indentation, -rate};
    case EventKind::contact_yields:
      return {indentation - law_->yield_threshold(history_), rate};
    case EventKind::contact_unloads:
      return {-rate, 0.0};
    case EventKind::section_reverses:
      break;
  }
  assert(false && "an event of sections has no function of the indentation");
  return {};
}

void ContactState::commit(double indentation) {
  if (loads()) history_ = ContactLaw::commit(history_, indentation);
}

void ContactState::pass(EventKind event, double indentation) {
  switch (event) {
    case EventKind::contact_begins:
      branch_ = law_->first_branch(history_);
      break;
    case EventKind::contact_yields:
      branch_ = ContactBranch::plastic;
      break;
    case EventKind::contact_unloads:
      history_ = ContactLaw::commit(history_, indentation);
      branch_ = ContactBranch::elastic;
      break;
    case EventKind::contact_ends:
      branch_ = ContactBranch::separated;
      break;
    case EventKind::section_reverses:
      assert(false && "sections pass their events in SectionField");
      break;
  }
}

}  // namespace subimpact
