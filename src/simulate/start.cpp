#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "model/mesh/modal_mesh.h"
#include "simulate/records/recorder.h"
#include "simulate/run_parts.h"
#include "simulate/settings/refuse.h"

namespace subimpact {
namespace {

// The motion of a mesh may differ by rounding from a rigid one.
constexpr double rounding = 1e-9;

// Displacements and rotations that supports, springs and bedding hold, of the two of a rigid body.
std::size_t n_held(const Beam& beam) {
  if (beam.foundation > 0.0) return 2;
  std::set<double> points;
  for (const int end : {0, 1}) {
    if (beam.ends[end] == EndSupport::clamped) return 2;
    if (beam.ends[end] == EndSupport::pinned) points.insert(end);
  }
  for (const Spring& spring : beam.springs) points.insert(spring.position);
  return std::min<std::size_t>(points.size(), 2);
}

void check_motion(const Beam& beam) {
  if (!beam.moves_at_start()) return;
  const auto [key, value] = beam.angular_velocity != 0.0
                                ? std::pair("beam.angular_velocity", beam.angular_velocity)
                                : std::pair("beam.velocity", beam.velocity);
  if (beam.fixed) {
    refuse(key, "is {:g}, but beam.fixed = true: the beam does not move; leave it out", value);
  }
  if (beam.start == BeamStart::equilibrium) {
    refuse(key,
           "is {:g}, but beam.start = \"equilibrium\" is a state of rest; leave one of them out",
           value);
  }
  for (const int end : {0, 1}) {
    if (beam.ends[end] == EndSupport::clamped) {
      refuse(key,
             "is {:g}, but a clamped end lets the beam neither move nor turn; allowed: 0; leave it "
             "out",
             value);
    }
    if (beam.ends[end] == EndSupport::free) continue;
    const double speed = std::abs(beam.angular_velocity) * beam.length + std::abs(beam.velocity);
    if (std::abs(beam.velocity_at(end)) <= rounding * speed) continue;
    refuse(
        key,
        "is {:g}, but with it the pinned end at x = {} would move at {:g} m/s; allowed: a motion "
        "about that end: beam.velocity = 0, and beam.pivot = {} (its default where the other end "
        "is free)",
        value, end == 0 ? "0" : "length", beam.velocity_at(end), end);
  }
}

void check_equilibrium(const Problem& problem) {
  const Beam& beam = problem.beam;
  if (beam.start != BeamStart::equilibrium) return;
  if (problem.gravity == 0.0 && !beam.has_loads()) {
    refuse("beam.start",
           "is \"equilibrium\", but no load acts on the beam; give scene.gravity, beam.load or "
           "beam.forces, or leave it out");
  }
  if (!beam.fixed && n_held(beam) < 2) {
    refuse("beam.start",
           "is \"equilibrium\", but nothing holds the beam against its loads; allowed with a "
           "clamped end, two pinned ends, two springs at different points or a bedding; leave it "
           "out, or add such supports");
  }
}

void check_approach(const Problem& problem) {
  const Bodies bodies = problem.bodies();
  const bool forced = bodies.gravity != 0.0 || problem.beam.has_loads();
  const bool apart = problem.striker.gap > 0.0;
  if (bodies.approach() > 0.0 || (apart && forced)) return;
  const bool rests = problem.beam.fixed || problem.beam.start == BeamStart::equilibrium;
  const bool is_set_down = bodies.approach() == 0.0 && bodies.gravity > 0.0 && rests &&
                           !problem.striker.fixed && !problem.beam.moves_at_start();
  if (is_set_down) return;
  const double of_beam = problem.beam.velocity_at(problem.striker.position);
  refuse(
      problem.beam.moves_at_start() ? "beam.velocity" : "striker.velocity",
      "gives the struck point {:g} m/s, and the {} {:g} m/s, so that they do not approach each "
      "other; allowed: a velocity of the striker minus that of the beam above 0 (a beam that "
      "moves towards a stop has a negative velocity){}",
      of_beam, problem.striker.fixed ? "stop has" : "striker has", bodies.striker_velocity(),
      forced
          ? ", or a striker.gap above 0 that gravity and loads close; a striker that is set down "
            "needs a beam at rest, beam.start = \"equilibrium\""
          : "");
}

void check_axial(const Beam& beam) {
  const bool is_first = beam.ends[0] == EndSupport::free;
  if (!beam.stretches() || (!is_first && beam.ends[1] != EndSupport::free)) return;
  refuse("beam.axial",
         "is \"held\", but the end at x = {} is free; allowed where both beam.ends are pinned or "
         "clamped; leave it out, or support that end",
         is_first ? "0" : "length");
}

void check_elastic(const StruckBeam& beam, std::span<const double> q) {
  const SectionField& sections = beam.sections();
  if (!sections.can_yield()) return;
  std::vector<double> kappa(sections.size());
  beam.mesh().curvatures(q, kappa);
  const Tension* tension = beam.tension();
  double largest = tension != nullptr ? tension->at(q) / tension->limit() : 0.0;
  for (std::size_t i = 0; i < kappa.size(); ++i) {
    const double limit = kappa[i] > 0.0 ? sections.window_high()[i] : -sections.window_low()[i];
    largest = std::max(largest, std::abs(kappa[i]) / limit);
  }
  if (largest < 1.0) return;
  refuse(
      "beam.start",
      "is \"equilibrium\", but under its loads the beam would be bent or stretched to {:.3g} times "
      "its yield curvature or stress; allowed: loads that leave it elastic; reduce them, or start "
      "straight",
      largest);
}

std::vector<double> rigid_velocities(const Problem& problem, const StruckBeam& beam) {
  const BeamMesh& mesh = beam.mesh();
  const Beam& of = problem.beam;
  const double at_zero = of.velocity_at(0.0);
  std::vector<double> v(mesh.momentum_functional().begin(), mesh.momentum_functional().end());
  const bool turns = of.angular_velocity != 0.0;
  const auto moment = mesh.moment_functional();
  const auto refuse_mesh = [&] {
    refuse(turns ? "beam.angular_velocity" : "beam.velocity",
           "is given, but this mesh cannot move as a rigid body; use another model.mesh");
  };
  if (turns && moment.empty()) refuse_mesh();
  for (std::size_t i = 0; i < v.size(); ++i) {
    v[i] = turns ? at_zero * v[i] + of.angular_velocity * moment[i] : of.velocity * v[i];
  }
  beam.mass_solver().solve(v);
  const double expected = of.velocity_at(problem.striker.position);
  const double speed = std::abs(of.angular_velocity) * of.length + std::abs(of.velocity);
  if (!(std::abs(mesh.struck_point()(v) - expected) <= 1e-6 * speed)) refuse_mesh();
  return v;
}

void check_same(const char* key, const std::string& here, const std::string& there) {
  if (here == there) return;
  refuse(key, "gives \"{}\", but the run to go on from has \"{}\"; use the same", here, there);
}

}  // namespace

void check_start(const Problem& problem) {
  check_axial(problem.beam);
  check_motion(problem.beam);
  check_equilibrium(problem);
  check_approach(problem);
}

void set_start(const Problem& problem, StruckBeam& beam) {
  const Bodies bodies = problem.bodies();
  const bool apart = bodies.has_approach_to_compute();
  if (!apart && beam.loads().is_empty() && !problem.beam.moves_at_start()) return;
  const std::size_t n = beam.mesh().n_unknowns();
  State y(2 * (n + 1), 0.0);
  if (problem.beam.start == BeamStart::equilibrium && !problem.beam.fixed) {
    const auto q = beam.equilibrium();
    if (!q) {
      refuse("beam.start",
             "is \"equilibrium\", but on this mesh the stiffness of the held beam is not positive "
             "definite; use a coarser mesh");
    }
    check_elastic(beam, *q);
    std::ranges::copy(*q, y.begin());
  }
  if (problem.beam.moves_at_start()) {
    std::ranges::copy(rigid_velocities(problem, beam), y.begin() + static_cast<long>(n) + 1);
  }
  y[n] = beam.mesh().struck_point()(beam.beam_positions(y)) - (apart ? problem.striker.gap : 0.0);
  y.back() = problem.striker.fixed ? 0.0 : bodies.striker_velocity();
  beam.set_start(std::move(y));
}

void exchange(Snapshot& snapshot, SubImpact& s) {
  snapshot(s.start, s.end, s.peak_force, s.peak_time, s.impulse, s.force_integral,
           s.max_indentation, s.residual_indentation, s.striker_velocity, s.start_rate, s.end_rate,
           s.opening);
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
void exchange(Snapshot& snapshot, SampledPeak& peak) {
  snapshot(peak.shared, peak.largest, peak.before, peak.after, peak.last, peak.is_last);
}
void exchange(Snapshot& snapshot, FieldPeaks& peaks) {
  snapshot(peaks.displacement, peaks.moment, peaks.strain, peaks.reaction_along,
           peaks.reaction_against);
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
           near_misses_, envelope, result_.peaks, result_.reactions[0], result_.reactions[1]);
  snapshot.require(steps_in_contact_.size() == result_.sub_impacts.size() &&
                   (!in_contact_ || !steps_in_contact_.empty()));
  if (!snapshot.reads()) return;
  row_instants_.resume(time);
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
