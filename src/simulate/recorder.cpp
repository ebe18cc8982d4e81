#include "simulate/recorder.h"

#include <algorithm>
#include <cmath>

#include "events/hermite.h"
#include "events/root.h"

namespace subimpact {

Recorder::Recorder(StruckBeam& beam, const State& initial, double interval, EventHandling events,
                   Result& result)
    : result_(result),
      interval_(interval),
      events_(events),
      striker_mass_(beam.striker_mass()),
      initial_energy_(beam.energies(initial).total()),
      initial_momentum_(beam.momentum(initial)) {}

void Recorder::on_step(const StepEnds& step, StruckBeam& beam, Integrator& integrator) {
  if (interval_ > 0.0) {
    for (;;) {
      const double t = static_cast<double>(next_row_) * interval_;
      if (t >= step.t1) break;  // the end itself is the next step's start
      if (t <= step.t0) {
        add_row(t, step.y0, beam);
      } else {
        integrator.state_at(t, state_);
        beam.look_within(step, t, state_, [&](const State& y) { add_row(t, y, beam); });
      }
      ++next_row_;
    }
  }
  if (!result_.first_section_yield && beam.sections().can_yield()) {
    result_.first_section_yield = beam.first_flow(step);
  }
  if (in_contact_) {
    const double indentation = beam.indentation(step.y1);
    follow_peak(indentation, beam.contact_force_at(indentation));
    look_for_peak(step, beam, integrator);
  }
}

void Recorder::follow_peak(double indentation, double force) {
  SubImpact& now = result_.sub_impacts.back();
  now.max_indentation = std::max(now.max_indentation, indentation);
  now.peak_force = std::max(now.peak_force, force);
}

void Recorder::look_for_peak(const StepEnds& step, StruckBeam& beam, Integrator& integrator) {
  // In the plastic branch the peak is an event; in the elastic one it lies inside some step.
  if (beam.contact_branch() != ContactBranch::elastic) return;
  const double rate0 = beam.indentation_rate(step.y0);
  if (!(rate0 > 0.0)) return;
  const double rate1 = beam.indentation_rate(step.y1);
  if (!(rate1 < 0.0)) return;
  const double h = step.length();
  const HermiteCubic path(beam.indentation(step.y0), rate0, beam.indentation(step.y1), rate1, h);
  const double guess = path.peak();
  if (path(guess) < result_.sub_impacts.back().max_indentation * (1.0 - 1e-3)) return;
  if (events_ == EventHandling::interpolated) {
    integrator.state_at(step.t0 + guess * h, state_);
  } else {
    RootOptions options;
    options.tolerance = 1e-2 * h;
    find_rise(
        [&](double t) {
          integrator.state_at(t, state_);
          return beam.evaluate({EventKind::contact_unloads}, state_);
        },
        step.t0, step.t1, step.t0 + guess * h, options);
  }
  follow_peak(beam.indentation(state_), beam.contact_force(state_));
}

void Recorder::before_event(const Transition& event, const State& y, StruckBeam& beam) {
  if (interval_ > 0.0) add_row(event.time, y, beam);
  result_.transitions.push_back(event);
  if (event.kind == EventKind::contact_begins) {
    in_contact_ = true;
    velocity_at_start_ = y.back();
    result_.sub_impacts.push_back({});
    result_.sub_impacts.back().start = event.time;
  } else if (event.kind == EventKind::contact_yields && !result_.first_contact_yield) {
    result_.first_contact_yield = event.time;
  } else if (event.kind == EventKind::contact_unloads) {
    follow_peak(beam.indentation(y), beam.contact_force(y));
  }
}

void Recorder::after_event(const Transition& event, const State& y, StruckBeam& beam) {
  if (event.kind == EventKind::contact_ends) {
    in_contact_ = false;
    SubImpact& ended = result_.sub_impacts.back();
    ended.end = event.time;
    ended.impulse = striker_mass_ * (velocity_at_start_ - y.back());
    ended.residual_indentation = beam.residual_indentation();
    ended.striker_velocity = y.back();
  }
  if (interval_ > 0.0) add_row(event.time, y, beam);
}

void Recorder::finish(double time, const State& y, StruckBeam& beam) {
  const HistoryRow last = make_row(time, y, beam);
  keep_errors(last);
  if (interval_ > 0.0 && (result_.history.empty() || result_.history.back().time < time)) {
    result_.history.push_back(last);
    add_section_rows(time, y, beam);
  }
  if (in_contact_) {
    SubImpact& open = result_.sub_impacts.back();
    open.impulse = striker_mass_ * (velocity_at_start_ - y.back());
    open.residual_indentation = beam.residual_indentation();
    open.striker_velocity = y.back();
  }
  for (const SubImpact& sub_impact : result_.sub_impacts) {
    result_.max_force = std::max(result_.max_force, sub_impact.peak_force);
    result_.max_indentation = std::max(result_.max_indentation, sub_impact.max_indentation);
  }
  result_.n_yielded_sections = beam.sections().n_yielded();
  result_.striker_velocity = y.back();
  result_.beam_mean_velocity = beam.beam_momentum(y) / beam.mesh().beam_mass();
}

void Recorder::add_row(double time, const State& y, StruckBeam& beam) {
  result_.history.push_back(make_row(time, y, beam));
  keep_errors(result_.history.back());
  add_section_rows(time, y, beam);
}

void Recorder::add_section_rows(double time, const State& y, StruckBeam& beam) {
  if (sections_.empty()) return;
  const StruckBeam::Bending bending = beam.bending(y);
  for (const std::size_t section : sections_) {
    const double kappa = bending.curvatures[section];
    const double moment = -bending.moments[section];
    result_.section_history.push_back({time, beam.mesh().section_positions()[section], kappa,
                                       moment, kappa + moment / beam.sections().stiffness()});
  }
}

void Recorder::keep_errors(const HistoryRow& row) {
  result_.max_energy_error = std::max(result_.max_energy_error, std::abs(row.energy_error));
  if (row.momentum_error) {
    result_.max_momentum_error =
        std::max(result_.max_momentum_error.value_or(0.0), std::abs(*row.momentum_error));
  }
}

HistoryRow Recorder::make_row(double time, const State& y, StruckBeam& beam) const {
  const Energies energies = beam.energies(y);
  const StruckBeam::Displacements at = beam.displacements(y);
  HistoryRow row{};
  row.time = time;
  row.force = beam.contact_force(y);
  row.indentation = beam.indentation(y);
  row.struck_displacement = at.struck;
  row.striker_displacement = at.striker;
  row.struck_deflection = at.struck - at.first_end;
  row.striker_relative = at.striker - at.first_end;
  row.striker_velocity = y.back();
  row.struck_velocity = y.back() - beam.indentation_rate(y);
  row.back_stress = beam.back_stress(y);
  row.striker_energy = energies.striker;
  row.beam_kinetic_energy = energies.beam_kinetic;
  row.bending_elastic = energies.bending_elastic;
  row.bending_plastic = energies.bending_plastic;
  row.contact_elastic = energies.contact_elastic;
  row.contact_plastic = energies.contact_plastic;
  row.energy_error = (energies.total() - initial_energy_) / initial_energy_;
  if (beam.conserves_momentum()) {
    row.momentum_error = (beam.momentum(y) - initial_momentum_) / initial_momentum_;
  }
  return row;
}

}  // namespace subimpact
