#include "subimpact/simulate/observer.h"

#include "simulate/observers.h"
#include "system/struck_beam.h"

namespace subimpact {

PointMotion RunView::striker() const {
  return {beam_.displacements(state_).striker, state_.back()};
}

PointMotion RunView::struck_point() const {
  return {beam_.displacements(state_).struck, state_.back() - beam_.indentation_rate(state_)};
}

bool RunView::in_contact() const { return beam_.in_contact(); }
double RunView::indentation() const { return beam_.indentation(state_); }
double RunView::residual_indentation() const { return beam_.residual_indentation(); }
double RunView::contact_force() const { return beam_.contact_force(state_); }
Energies RunView::energies() const { return beam_.energies(state_); }

void Observers::on_step(const StepEnds& step, StruckBeam& beam, Integrator& integrator) {
  recorder_.on_step(step, beam, integrator);
}

void Observers::on_accepted(double time, const State& y, StruckBeam& beam) {
  recorder_.on_accepted(time, y, beam);
  guest_.on_step({time, y, beam});
}

void Observers::on_turn(const Transition& turn) {
  recorder_.on_turn(turn);
  guest_.on_reversal(turn);
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
