#include "subimpact/simulate/observer.h"

#include "simulate/observers.h"
#include "system/accounts.h"

namespace subimpact {

PointMotion RunView::striker() const {
  return {Accounts(beam_).displacements(state_).striker, state_.back()};
}

PointMotion RunView::struck_point() const {
  return {Accounts(beam_).displacements(state_).struck,
          state_.back() - beam_.indentation_rate(state_)};
}

bool RunView::in_contact() const { return beam_.contact().is_closed(); }
double RunView::indentation() const { return beam_.indentation(state_); }
double RunView::residual_indentation() const { return beam_.contact().residual_indentation(); }
double RunView::contact_force() const { return beam_.contact_force(state_); }
Energies RunView::energies() const { return Accounts(beam_).energies(state_); }

void Observers::on_step(const ObservedStep& step, StruckBeam& beam) {
  recorder_.on_step(step, beam);
}

void Observers::on_accepted(double time, const State& y, StruckBeam& beam) {
  recorder_.on_accepted(time, y, beam);
  guest_.on_step({time, y, beam});
}

void Observers::on_reversal(const Transition& reversal) {
  recorder_.on_reversal(reversal);
  guest_.on_reversal(reversal);
}

void Observers::before_event(const Transition& event, const State& y, StruckBeam& beam) {
  recorder_.before_event(event, y, beam);
  guest_.before_event(event, {event.time, y, beam});
}

void Observers::after_event(const Transition& event, const State& y, StruckBeam& beam) {
  recorder_.after_event(event, y, beam);
  guest_.after_event(event, {event.time, y, beam});
}

}  // namespace subimpact
