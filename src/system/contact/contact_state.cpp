#include "system/contact/contact_state.h"

#include <cassert>
#include <limits>
#include <stdexcept>

#include "model/contact/power_contact.h"

namespace subimpact {

std::string_view to_string(EventKind kind) {
  static constexpr std::string_view names[] = {
      "contact_begins",   "contact_yields",  "contact_unloads", "contact_ends",
      "section_reverses", "support_touches", "support_lifts"};
  return names[static_cast<std::size_t>(kind)];
}

std::span<const EventFunction> ContactState::event_functions() const {
  static constexpr EventFunction separated[] = {{EventKind::contact_begins}};
  static constexpr EventFunction elastic[] = {{EventKind::contact_ends},
                                              {EventKind::contact_yields}};
  static constexpr EventFunction plastic[] = {{EventKind::contact_unloads}};
  static constexpr EventFunction damped[] = {{EventKind::contact_ends},
                                             {EventKind::contact_ends, EventVariable::rate}};
  static constexpr EventFunction recovering[] = {{EventKind::contact_begins, EventVariable::rate},
                                                 {EventKind::contact_ends}};
  switch (branch_) {
    case ContactBranch::separated:
      if (recovering_) return recovering;
      return separated;
    case ContactBranch::elastic:
      if (is_damped()) return damped;
      return elastic;
    case ContactBranch::plastic:
      return plastic;
  }
  return {};
}

double ContactState::force(double indentation) const {
  return law_->branch_force(branch_at(indentation), history_, indentation);
}

double ContactState::slope(double indentation) const {
  return law_->branch_slope(branch_at(indentation), history_, indentation);
}

ContactState::Energies ContactState::energies(double indentation) const {
  const ContactHistory reached = loads() ? ContactLaw::commit(history_, indentation) : history_;
  return {is_closed() || recovering_ ? law_->recoverable_energy(reached, indentation) : 0.0,
          law_->dissipated_energy(reached)};
}

EventValue ContactState::event_function(const EventFunction& function, double indentation,
                                        double rate) const {
  if (function.kind == EventKind::contact_unloads) return {-rate, 0.0};
  if (function.of_rate()) {
    const double above = rate + 1.0 / damping_;
    return {function.kind == EventKind::contact_ends ? -above : above, 0.0};
  }
  switch (function.kind) {
    case EventKind::contact_begins:
      return {indentation - residual_indentation(), rate};
    case EventKind::contact_ends:
      return {residual_indentation() - indentation, -rate};
    case EventKind::contact_yields:
      return {indentation - law_->yield_threshold(history_), rate};
    default:
      assert(false && "this event has no function of the indentation");
      return {};
  }
}

void ContactState::pass(const EventFunction& event, double indentation) {
  recovering_ = event.kind == EventKind::contact_ends && event.of_rate();
  switch (event.kind) {
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
    default:
      assert(false && "sections pass their events in SectionField, supports as contacts");
  }
}

std::size_t LiftingSupport::half_bandwidth() const {
  const auto [low, high] =
      std::ranges::minmax(approach.terms, {}, &SparseFunctional::Term::unknown);
  return high.unknown - low.unknown;
}

// Far above the rounding of displacements, far below those that make a force to speak of.
constexpr double dead_share = 1e-12;

std::vector<LiftingSupport> lifting_supports(const BeamMesh& mesh, const Beam& beam,
                                             double length_scale) {
  std::vector<LiftingSupport> all;
  for (std::size_t i = 0; i < beam.springs.size(); ++i) {
    const auto& [position, stiffness, one_sided] = beam.springs[i];
    if (!one_sided || (mesh.symmetric() && position > 0.5)) continue;
    const double x = position * beam.length;
    const std::optional<SparseFunctional> at = mesh.displacement_at(x);
    if (!at || !at->dense.empty()) {
      throw std::invalid_argument("a support that lifts: a mesh without displacement_at()");
    }
    if (at->is_zero()) continue;  // on a support that holds
    const double sense = one_sided->side == SpringSide::behind ? 1.0 : -1.0;
    SparseFunctional approach;
    approach.add(sense, *at);
    constexpr double never = std::numeric_limits<double>::infinity();
    all.push_back(
        {i, x, sense, one_sided->gap, mesh.symmetric() && position < 0.5 ? 2.0 : 1.0,
         std::move(approach),
         ContactState(std::make_shared<PowerContact>(stiffness, 1.0, never), one_sided->damping),
         dead_share * length_scale});
  }
  return all;
}

}  // namespace subimpact
