#include "simulate/records/recorder.h"

#include <utility>

#include "numerics/bracketed_root.h"
#include "numerics/hermite.h"
#include "numerics/lanes.h"
#include "simulate/run_parts.h"
#include "system/readings/accounts.h"

namespace subimpact {
namespace {

// Tolerated error of the integral of the force over a step, as a share of that of an impulse.
constexpr double share_of_step = 1.0 / 128.0;

// Change of force between rows, as a share of the largest force so far, if rows follow the force.
constexpr double change_of_force = 0.01;

// A tensile force is tolerated within so many roundings of displacements of the contact's end.
constexpr double tolerated_rounding = 64.0;

// Places at which the largest rotation is looked for, both ends of the part modelled among them.
constexpr int n_rotations = 17;

}  // namespace

Recorder::Recorder(const StruckBeam& beam, double interval, EventHandling events, Audit& audit,
                   Result& result, RowSink* rows)
    : result_(result),
      kept_rows_(result),
      rows_(rows != nullptr ? *rows : kept_rows_),
      row_instants_(interval),
      events_(events),
      audit_(audit),
      accounts_(beam),
      first_flow_(beam.sections().size()),
      force_(share_of_step * audit.tolerated_impulse()),
      losses_(audit, events),
      supports_(beam),
      largest_gap_(events != EventHandling::interpolated),
      striker_mass_(beam.striker_mass()) {
  last_row_.time = -1.0;  // none yet
}

void Recorder::on_approach(double end, StruckBeam& beam) {
  while (row_instants_.next() < end) {
    const double t = row_instants_.next();
    row_instants_.reach(t);
    add_row(t, beam.state_before_touch(end - t), accounts_);
  }
}

void Recorder::keep_fields(const RunParts& parts) {
  const BeamMesh& mesh = parts.beam.mesh();
  length_ = parts.problem.beam.length;
  half_height_ = 0.5 * parts.problem.beam.height();
  for (const double fraction : parts.given.output.sections) {  // or its mirror image
    const double x = length_ * (mesh.symmetric() ? std::min(fraction, 1.0 - fraction) : fraction);
    sections_.push_back(mesh.nearest_section(x));
  }
  const double end = mesh.symmetric() ? 0.5 * length_ : length_;
  for (int i = 0; i < n_rotations; ++i) {
    const auto rotation = mesh.rotation_at(end * i / (n_rotations - 1));
    if (rotation) rotations_.push_back(*rotation);
  }
  rigid_motion_ =
      rigid_motion_at_struck_point(parts.beam, parts.problem.beam, parts.problem.striker.position);
  auto fields = std::make_unique<FieldRecorder>(parts, result_, rows_);
  if (fields->is_needed()) fields_ = std::move(fields);
}

void Recorder::on_step(const ObservedStep& step, StruckBeam& beam) {
  if (follows_force_ && in_contact_) add_row_of_force(step, beam);
  if (row_instants_.exist() || fields_) add_rows_within(step, beam);
  if (!result_.first_section_yield) {
    result_.first_section_yield = first_flow_.find(beam, step.ends());
  }
  if (in_contact_) {
    ++steps_in_contact_.back();
    integrate_force(step, beam);
    follow_peak(step.t1(), step.indentation().lambda1, beam);
    if (beam.contact().is_damped()) {
      const double so_far = result_.sub_impacts.back().peak_force;
      const auto [time, force] = largest_force(step, beam, 0, so_far, state_);
      follow_force(time, force);
    }
    look_for_peak(step, beam);
  } else if (!result_.sub_impacts.empty()) {
    largest_gap_.follow(step, beam, *result_.sub_impacts.back().opening);
  }
  near_misses_.follow(step, beam, events_ == EventHandling::located);
  supports_.on_step(step, beam, result_);
  if (observer_ != nullptr) observer_->within_step({step, beam, state_});
}

void Recorder::add_row_of_force(const ObservedStep& step, const StruckBeam& beam) {
  const double change = std::abs(beam.contact_force(step.y0()) - last_row_.force);
  if (change < change_of_force * result_.max_force || !(step.t0() > last_row_.time)) return;
  add_row(step.t0(), step.y0(), accounts_);
}

void Recorder::add_rows_within(const ObservedStep& step, StruckBeam& beam) {
  if (step.ends().event_free) {
    row_times_.clear();
    if (row_instants_.exist()) {
      row_instants_.add_below(step.t1(), row_times_);
    } else {
      fields_->add_instants(step.t1(), row_times_);
    }
    step.integrator().expect(row_times_);
  }
  for (;;) {
    const double row_time = row_instants_.next();
    const double shape_time = fields_ ? fields_->next_instant() : HUGE_VAL;
    const bool both =
        std::isfinite(row_time) && std::abs(row_time - shape_time) <= same_instant * row_time;
    const double t = both ? row_time : std::min(row_time, shape_time);
    if (!(t < step.t1())) return;  // the end itself is the next step's start
    const bool row = t == row_time;
    const bool shape = both || t == shape_time;
    if (row) row_instants_.reach(t);
    if (t <= step.t0()) {
      add_rows(t, row, shape, step.y0(), accounts_);
      continue;
    }
    step.corrected_state_at(t, state_, correction_);
    const Losses before = beam.losses();
    const bool has_losses = row && beam.has_losses();
    if (has_losses) {
      beam.add_losses(losses_.over(step, t, state_, beam));
      beam.add_support_impulses(losses_.support_impulses());
    }
    if (correction_.is_empty()) {
      add_rows(t, row, shape, state_, accounts_);
    } else {
      const SectionField reached = correction_.reversed(beam.sections());
      Accounts accounts(beam, reached);
      add_rows(t, row, shape, state_, accounts);
    }
    beam.set_losses(before);
    if (has_losses) beam.add_support_impulses(losses_.support_impulses(), -1.0);
  }
}

void Recorder::add_rows(double time, bool row, bool shape, const State& y, Accounts& accounts) {
  if (row) add_row(time, y, accounts);
  if (shape) fields_->take_instant(time, y, accounts);
}

void Recorder::on_accepted(double time, const State& y, StruckBeam& beam) {
  check_push(time, y, beam);
  if (observer_ != nullptr) observer_->on_step({time, y, beam});
}

void Recorder::on_reversal(const Transition& reversal) {
  result_.transitions.push_back(reversal);
  if (observer_ != nullptr) observer_->on_reversal(reversal);
}

void Recorder::check_push(double time, const State& y, const StruckBeam& beam) {
  if (!in_contact_ || steps_in_contact_.back() == 0) return;
  const double force = beam.contact_force(y);
  if (force >= 0.0) return;
  const double depth = beam.indentation(y) - beam.contact().residual_indentation();
  if (depth <= tolerated_rounding * beam.displacement_rounding(y)) return;  // rounding
  audit_.check(time, y);  // a blow-up is called by its name
  check_push(time, force);
}

void Recorder::integrate_force(const ObservedStep& step, const StruckBeam& beam) {
  double& integral = result_.sub_impacts.back().force_integral;
  if (events_ == EventHandling::interpolated) {
    integral += force_.roughly_up_to(step.t1(), step.y1(), step, beam);
    return;
  }
  integral += force_.over(step, beam);
  follow_peak(0.5 * (step.t0() + step.t1()), force_.largest_indentation(), beam);
}

void Recorder::follow_peak(double time, double indentation, const StruckBeam& beam) {
  SubImpact& now = result_.sub_impacts.back();
  if (!(indentation > now.max_indentation)) return;
  now.max_indentation = indentation;
  result_.max_indentation = std::max(result_.max_indentation, indentation);
  if (!beam.contact().is_damped()) follow_force(time, beam.contact().force(indentation));
}

void Recorder::follow_force(double time, double force) {
  SubImpact& now = result_.sub_impacts.back();
  if (!(force > now.peak_force)) return;
  now.peak_force = force;
  now.peak_time = time;
  result_.max_force = std::max(result_.max_force, force);
}

void Recorder::look_for_peak(const ObservedStep& step, StruckBeam& beam) {
  // In the plastic branch the peak is an event; in the elastic one it lies inside some step.
  if (beam.contact().branch() != ContactBranch::elastic) return;
  const auto& [t0, t1, lambda0, rate0, lambda1, rate1] = step.indentation();
  const double h = step.length();
  const HermiteCubic path(lambda0, rate0, lambda1, rate1, h);
  const std::optional<double> peak = path.maximum();
  if (!peak || path(*peak) < result_.sub_impacts.back().max_indentation * (1.0 - 1e-3)) return;
  const double guess = *peak;
  double time = t0 + guess * h;
  if (events_ == EventHandling::interpolated) {
    step.state_at(time, state_);
  } else {
    time = find_rise(
        [&](double t) {
          step.state_at(t, state_);
          beam.set_time(t);
          return beam.evaluate({EventKind::contact_unloads}, state_);
        },
        rate0 > 0.0 ? t0 : t0 + path.extrema().first * h,
        rate1 < 0.0 ? t1 : t0 + path.extrema().second * h, time, 1e-2 * h);
  }
  follow_peak(time, beam.indentation(state_), beam);
}

void Recorder::before_event(const Transition& event, const State& y, StruckBeam& beam) {
  force_.forget_neighbour();
  if (event.spring) {
    if (event.kind == EventKind::support_lifts) supports_.lift(event, beam, result_);
    result_.transitions.push_back(event);
    if (observer_ != nullptr) observer_->before_event(event, {event.time, y, beam});
    return;
  }
  add_event_row(event, y);
  if (fields_) fields_->add_shape(event.time, y, accounts_);
  result_.transitions.push_back(event);
  if (event.kind == EventKind::contact_begins) {
    in_contact_ = true;
    velocity_at_start_ = y.back();
    beam_impulse_at_start_ = accounts_.beam_impulse(y, event.time);
    if (result_.sub_impacts.empty()) result_.first_touch = velocities(event.time, y);
    result_.sub_impacts.push_back({});
    steps_in_contact_.push_back(0);
    result_.sub_impacts.back().start = event.time;
    result_.sub_impacts.back().start_rate = beam.indentation_rate(y);
    begin(NearMissKind::opening, beam);
  } else if (event.kind == EventKind::contact_yields && !result_.first_contact_yield) {
    result_.first_contact_yield = event.time;
  } else if (event.kind == EventKind::contact_unloads) {
    follow_peak(event.time, beam.indentation(y), beam);
  }
  if (observer_ != nullptr) observer_->before_event(event, {event.time, y, beam});
}

void Recorder::after_event(const Transition& event, const State& y, StruckBeam& beam) {
  if (event.kind == EventKind::contact_ends) {
    follow_deformation(y);
    SubImpact& ended = result_.sub_impacts.back();
    ended.end = event.time;
    ended.end_rate = beam.indentation_rate(y);
    ended.opening = 0.0;
    begin(NearMissKind::closing, beam);
    close_sub_impact(event.time, y, beam);
    result_.parting = velocities(event.time, y);
    in_contact_ = false;
    audit_.check_impulse(event.time, ended.impulse, ended.force_integral);
    if (!(ended.peak_force > 0.0)) {
      audit_.fail(event.time, OutcomeKind::inaccurate,
                  "a contact began and ended without a force between the bodies");
    }
  }
  if (event.kind == EventKind::contact_begins && !result_.first_contact_yield &&
      beam.contact().branch() == ContactBranch::plastic) {
    result_.first_contact_yield = event.time;
  }
  if (!event.spring) add_event_row(event, y);
  if (observer_ != nullptr) observer_->after_event(event, {event.time, y, beam});
}

void Recorder::follow_deformation(const State& y) {
  const auto unknowns = accounts_.beam().beam_positions(y);
  for (const SparseFunctional& rotation : rotations_) {
    result_.largest_rotation = std::max(result_.largest_rotation, std::abs(rotation(unknowns)));
  }
  follow_displacement(accounts_.beam().mesh().struck_point()(unknowns));
}

void Recorder::begin(NearMissKind kind, const StruckBeam& beam) {
  near_misses_.finish(beam.contact().residual_indentation(), result_.near_misses);
  near_misses_.begin(kind);
}

void Recorder::add_event_row(const Transition& event, const State& y) {
  if (!row_instants_.exist()) return;
  HistoryRow row = make_row(event.time, y, accounts_);
  // At these events the force is zero but for the rounding of the event's time.
  if (event.kind == EventKind::contact_begins || event.kind == EventKind::contact_ends)
    row.force = 0.0;
  keep(row, y, accounts_);
}

void Recorder::close_sub_impact(double time, const State& y, const StruckBeam& beam) {
  SubImpact& closed = result_.sub_impacts.back();
  if (!beam.has_stop()) {
    const double fallen = beam.striker_load() * (time - closed.start);
    closed.impulse = striker_mass_ * (velocity_at_start_ - y.back() + fallen);
  } else if (!beam.mesh().translation().empty()) {
    closed.impulse = accounts_.beam_impulse(y, time) - beam_impulse_at_start_;
  } else {
    closed.impulse = closed.force_integral;
  }
  closed.residual_indentation = beam.contact().residual_indentation();
  closed.striker_velocity = y.back();
}

void Recorder::finish(double time, const State& y, const StruckBeam& beam, bool is_good) {
  if (is_good && row_instants_.exist() && last_row_.time < time) add_row(time, y, accounts_);
  if (fields_) fields_->finish(time, y, accounts_, is_good);
  follow_deformation(y);
  if (in_contact_) {
    close_sub_impact(time, y, beam);
  } else {
    result_.closest_approach = near_misses_.closest(time, y, beam);
  }
  near_misses_.finish(beam.contact().residual_indentation(), result_.near_misses);
  supports_.finish(beam, length_, result_);
  result_.final_energies = accounts_.energies(y, time);
  if (result_.sub_impacts.empty() || !result_.sub_impacts.front().end) {
    result_.parting = velocities(time, y);
  } else {
    const double met_at = result_.first_touch.striker - result_.first_touch.beam;
    const double parted_at = result_.parting.beam - result_.parting.striker;
    const bool is_over = parted_at >= 0.0 || result_.no_more_contact;
    if (met_at > 0.0 && is_over) result_.restitution = parted_at / met_at;
  }
  result_.n_yielded_sections = beam.sections().n_yielded();
  result_.striker_velocity = y.back();
  result_.beam_mean_velocity = accounts_.beam_momentum(y) / beam.mesh().beam_mass();
  result_.contact_damping_loss = beam.losses().contact;
  result_.beam_damping_loss = beam.losses().beam;
  result_.max_energy_error = audit_.max_energy_error();
  result_.max_momentum_error = audit_.max_momentum_error();
  result_.max_impulse_error = audit_.max_impulse_error();
}

void Recorder::add_row(double time, const State& y, Accounts& accounts) {
  HistoryRow row = make_row(time, y, accounts);
  if (in_contact_) follow_peak(row.time, row.indentation, accounts.beam());
  if (!(row.force >= 0.0)) {
    const StruckBeam& beam = accounts.beam();
    const double slope = std::abs(beam.contact().slope(beam.indentation(y)));
    check_push(time, row.force + slope * beam.displacement_rounding(y));
    row.force = 0.0;  // the law's own force there
  }
  keep(row, y, accounts);
}

void Recorder::keep(const HistoryRow& row, const State& y, Accounts& accounts) {
  ++result_.n_history_rows;
  last_row_ = row;
  rows_.add(row);
  add_section_rows(row.time, y, accounts);
  if (fields_) fields_->follow(row.time, y, accounts);
}

void Recorder::check_push(double time, double force) const {
  if (force >= -audit_.tolerated_energy() * result_.max_force) return;
  // Where the run has hardly begun, a pull too weak to have an impulse is rounding.
  if (-force * time <= audit_.tolerated_impulse()) return;
  audit_.fail(time, OutcomeKind::inaccurate,
              "within a contact the force is {:.3g} N: the bodies would pull at each other", force);
}

void Recorder::add_section_rows(double time, const State& y, Accounts& accounts) {
  if (sections_.empty()) return;
  const Accounts::Bending bending = accounts.bending(y);
  const StruckBeam& beam = accounts.beam();
  for (const std::size_t section : sections_) {
    const double kappa = bending.curvatures[section], moment = bending.moments[section];
    rows_.add(SectionRow{time, beam.mesh().section_positions()[section], kappa, moment,
                         plastic_curvature(kappa, moment, beam.sections().stiffness()),
                         -half_height_ * kappa});
  }
}

Result::Velocities Recorder::velocities(double time, const State& y) const {
  const std::span<const double> of_beam = accounts_.beam().beam_velocities(y);
  return {time, y.back(), dot(rigid_motion_.data(), of_beam.data(), rigid_motion_.size())};
}

HistoryRow Recorder::make_row(double time, const State& y, Accounts& accounts) {
  const Energies energies = accounts.energies(y, time);
  audit_.check(time, y, energies);
  const Accounts::Displacements at = accounts.displacements(y);
  follow_displacement(at.struck);
  HistoryRow row{};
  const StruckBeam& beam = accounts.beam();
  row.time = time;
  row.force = beam.contact_force(y);
  row.indentation = beam.indentation(y);
  row.struck_displacement = at.struck;
  row.striker_displacement = at.striker;
  row.struck_deflection = at.struck - at.first_end;
  row.striker_relative = at.striker - at.first_end;
  row.striker_velocity = y.back();
  row.struck_velocity = y.back() - beam.indentation_rate(y);
  row.back_stress = accounts.back_stress(y);
  row.striker_energy = energies.striker;
  row.beam_kinetic_energy = energies.beam_kinetic;
  row.bending_elastic = energies.bending_elastic;
  row.bending_plastic = energies.bending_plastic;
  row.contact_elastic = energies.contact_elastic;
  row.contact_plastic = energies.contact_plastic;
  row.energy_error = audit_.energy_error(energies);
  row.momentum_error = audit_.momentum_error(time, y);
  row.beam_damping = energies.beam_damping;
  row.work = energies.work;
  if (fields_) fields_->add_readings(row, y, accounts);
  return row;
}

}  // namespace subimpact
