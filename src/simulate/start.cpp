#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

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
  double load = problem.gravity * beam.mass() + beam.load * beam.length;
  for (const PointForce& force : beam.forces) load += force.table.front().second;
  if ((beam.rests[0] || beam.rests[1]) && !(load > 0.0)) {
    refuse(
        "beam.ends",
        "has an end that \"rests\", but no load presses the beam on it; give scene.gravity above "
        "0, or a beam.load, or put beam.springs with one_sided = true in its place");
  }
  if (problem.gravity == 0.0 && !beam.has_loads()) {
    refuse("beam.start",
           "is \"equilibrium\", but no load acts on the beam; give scene.gravity, beam.load or "
           "beam.forces, or leave it out");
  }
  if (!beam.fixed && n_held(beam) < 2) {
    refuse("beam.start",
           "is \"equilibrium\", but nothing holds the beam against its loads; allowed with a "
           "clamped end, two pinned ends, two springs or supports that lift (one_sided = true, "
           "\"rests\") at different points or a bedding; leave it out, or add such supports");
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
    if (!q && problem.beam.may_lift()) {
      refuse("beam.start",
             "is \"equilibrium\" (which an end that \"rests\" needs), but under its loads the beam "
             "tips or lifts off the supports that would hold it; allowed: loads that press it on "
             "two of them at least; move or add supports, or reverse the load");
    }
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

void check_next_strike(const Problem& problem) {
  if (!problem.is_one_of_several) return;
  const Beam& beam = problem.beam;
  const std::pair<const char*, bool> others[] = {
      {"scene.gravity", problem.gravity != 0.0},
      {"beam.load", beam.load != 0.0},
      {"beam.forces", !beam.forces.empty()},
      {"beam.velocity", beam.velocity != 0.0},
      {"beam.angular_velocity", beam.angular_velocity != 0.0},
      {"striker.fixed", problem.striker.fixed},
      {beam.rests[0] || beam.rests[1] ? "beam.ends" : "beam.springs", beam.may_lift()}};
  for (const auto& [key, is_given] : others) {
    if (!is_given) continue;
    refuse(key,
           "is given, but only a beam without loads, stop, supports that lift and motion of its "
           "own is struck again; leave it out, or set repeat.strikes = 1");
  }
  if (problem.striker.gap > 0.0 && !problem.at_rest) {
    refuse("striker.gap",
           "is above 0, but the beam that is struck moves meanwhile; allowed: 0; leave it out, or "
           "set strike.rest = true");
  }
}

void begin_next_strike(RunParts& parts) {
  const bool at_rest = parts.problem.at_rest;
  try {
    parts.beam.begin_strike(*parts.problem.start, at_rest,
                            2.0 * M_PI / parts.settings.first_period);
  } catch (const std::invalid_argument& error) {
    refuse("model.mesh", "{}; use the same", error.what());
  } catch (const std::domain_error& error) {
    if (at_rest) refuse("strike.rest", "is true, but {}; use false", error.what());
    refuse("striker.velocity", "is too low: {}; use strike.rest = true", error.what());
  }
}

}  // namespace subimpact
