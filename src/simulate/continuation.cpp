#include <cmath>
#include <limits>
#include <stdexcept>

#include "model/modal_mesh.h"
#include "simulate/recorder.h"
#include "simulate/refuse.h"
#include "simulate/run_parts.h"

namespace subimpact {
namespace {

void check_same(const char* key, const std::string& here, const std::string& there) {
  if (here == there) return;
  refuse(key, "gives \"{}\", but the run to go on from has \"{}\"; use the same", here, there);
}

}  // namespace

void exchange(Snapshot& snapshot, SubImpact& s) {
  snapshot(s.start, s.end, s.peak_force, s.peak_time, s.impulse, s.force_integral,
           s.max_indentation, s.residual_indentation, s.striker_velocity, s.start_rate, s.end_rate);
}
void exchange(Snapshot& snapshot, Result::Velocities& at) {
  snapshot(at.time, at.striker, at.beam);
}
void exchange(Snapshot& snapshot, Transition& event) {
  snapshot(event.time, event.kind, event.section, event.value);
}
void exchange(Snapshot& snapshot, NearMiss& near_miss) {
  snapshot(near_miss.time, near_miss.margin, near_miss.kind);
}
void exchange(Snapshot& snapshot, EnvelopeRow::Range& range) {
  auto& [smallest, largest] = range;
  snapshot(smallest.value, smallest.time, largest.value, largest.time);
}
void exchange(Snapshot& snapshot, EnvelopeRow& row) {
  snapshot(row.position, row.displacement, row.moment, row.strain, row.plastic_curvature);
}

void NearMissSearch::exchange(Snapshot& snapshot) {
  std::optional<double> farthest;
  if (std::isfinite(farthest_)) farthest = farthest_;
  snapshot(kind_, sense_, farthest, kept_, n_);
  farthest_ = farthest.value_or(-std::numeric_limits<double>::infinity());
  snapshot.require(n_ <= kept_.size());
}

void Recorder::exchange(Snapshot& snapshot, double time) {
  std::vector<EnvelopeRow> envelope;
  if (fields_) envelope = fields_->envelope();
  snapshot(result_.sub_impacts, result_.transitions, result_.near_misses,
           result_.first_section_yield, result_.first_contact_yield, result_.largest_rotation,
           result_.largest_displacement, result_.first_touch, result_.parting, in_contact_,
           velocity_at_start_, beam_impulse_at_start_, largest_force_, steps_in_contact_,
           near_misses_, envelope);
  snapshot.require(steps_in_contact_.size() == result_.sub_impacts.size() &&
                   (!in_contact_ || !steps_in_contact_.empty()));
  if (!snapshot.reads()) return;
  if (interval_ > 0.0) next_row_ = first_after(time, interval_);
  last_row_.time = time;
  if (fields_) fields_->resume(time, envelope);
}

bool goes_on(const RunState* start, const Striker& striker, const std::optional<bool>& at_rest) {
  return start != nullptr && !at_rest && start->striker.mass == striker.mass &&
         start->striker.velocity == striker.velocity && start->striker.gap == striker.gap &&
         start->striker.drop_height == striker.drop_height;
}

void check_continuation(const Problem& problem, const Options& options,
                        const ResolvedSettings& used) {
  if (!problem.start) return;
  const RunState& start = *problem.start;
  check_same("model.mesh", used.mesh.substr(0, used.mesh.find(modal_description)), start.mesh);
  check_same("model.section", used.section, start.section);
  check_same("contact.law", used.contact_law, start.contact_law);
  if (start.striker.position != problem.striker.position) {
    refuse("striker.position",
           "is {}, but the run to go on from struck at {}, where the dent is; use the same",
           problem.striker.position, start.striker.position);
  }
  if (goes_on(problem)) {
    if (options.end_time > start.time) return;
    refuse("time.end",
           "is {:.6g} s, but the run to go on from ended at {:.6g} s; allowed: later times; or set "
           "strike.rest for another strike",
           options.end_time, start.time);
  }
  const Beam& beam = problem.beam;
  const std::pair<const char*, bool> others[] = {
      {"scene.gravity", problem.gravity != 0.0},
      {"beam.load", beam.load != 0.0},
      {"beam.forces", !beam.forces.empty()},
      {"beam.velocity", beam.velocity != 0.0},
      {"beam.angular_velocity", beam.angular_velocity != 0.0},
      {"striker.fixed", problem.striker.fixed}};
  for (const auto& [key, is_given] : others) {
    if (!is_given) continue;
    refuse(key,
           "is given, but only a beam without loads, stop and motion of its own is struck again; "
           "leave it out, or go on with the same strike to a later time.end");
  }
  if (problem.striker.gap > 0.0 && !problem.at_rest.value_or(false)) {
    refuse("striker.gap",
           "is above 0, but the beam that is struck moves meanwhile; allowed: 0; leave it out, or "
           "set strike.rest = true");
  }
}

void begin_from(const RunState& start, RunParts& parts) {
  State y(2 * parts.beam.n_positions());
  try {
    Snapshot snapshot = Snapshot::reading(start.numbers);
    parts.beam.exchange(snapshot, y);
    snapshot.finish();
  } catch (const std::runtime_error& error) {
    refuse("model", "does not take the state to go on from: {}", error.what());
  }
  if (goes_on(parts.problem)) return parts.beam.resume(y);
  const bool at_rest = parts.problem.at_rest.value_or(false);
  try {
    parts.beam.begin_strike(y, at_rest, 2.0 * M_PI / parts.settings.first_period);
  } catch (const std::domain_error& error) {
    if (at_rest) refuse("strike.rest", "is true, but {}; use false", error.what());
    refuse("striker.velocity", "is too low: {}; use strike.rest = true", error.what());
  }
}

void read_records(const RunState& start, Audit& audit, Recorder& recorder) {
  Snapshot snapshot = Snapshot::reading(start.numbers);
  snapshot.begin("accounts");
  snapshot(audit);
  snapshot.begin("records");
  recorder.exchange(snapshot, start.time);
  snapshot.finish();
}

std::shared_ptr<const RunState> end_state(RunParts& parts, double time, State y, Audit& audit,
                                          Recorder& recorder) {
  auto state = std::make_shared<RunState>();
  state->time = time;
  state->striker = parts.problem.striker;
  state->mesh = parts.settings.mesh.substr(0, parts.settings.mesh.find(modal_description));
  state->section = parts.settings.section;
  state->contact_law = parts.settings.contact_law;
  Snapshot snapshot = Snapshot::writing(state->numbers);
  parts.beam.exchange(snapshot, y);
  snapshot.begin("accounts");
  snapshot(audit);
  snapshot.begin("records");
  recorder.exchange(snapshot, time);
  return state;
}

}  // namespace subimpact
