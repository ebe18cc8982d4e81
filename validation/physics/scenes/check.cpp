// Scenes beyond a mass that strikes a beam at rest: published tests and closed forms.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "case/problem.h"
#include "outcome.h"
#include "subimpact/case/simulate.h"
#include "subimpact/model/mesh/beam_mesh.h"

namespace subimpact::validation {
namespace {

const std::vector<std::string> methods = {"exponential", "nystrom", "erk"};

// code_aster, SDND101.
void add_sdnd101(Outcome& outcome) {
  const Result result = simulate(case_of("scenes"));
  const SubImpact& first = result.sub_impacts.at(0);
  const SubImpact& second = result.sub_impacts.at(1);
  const auto add = [&](const char* what, double published, double ours, double tolerance) {
    outcome.rows.push_back(
        {std::string("SDND101: ") + what, published, ours, Bound::relative, tolerance});
  };
  add("instant of the largest force, s", 0.01563, first.peak_time, 1e-2);
  add("largest force, N", 9950.0, first.peak_force, 1e-3);
  add("that of the second shock, s", 0.361, second.peak_time, 1e-3);
  add("largest force then, N", 9950.0, second.peak_force, 1e-3);
  add("duration, s", 0.03126, second.end.value() - second.start, 1e-2);
  add("impulse, N s", 198.05, second.impulse, 1e-3);
  add("velocity of impact, m/s", 1.0, second.start_rate, 1e-3);
}

// NAFEMS R0016, 5T. The solutions of codes in public suites differ by up to 1.3 % in displacement,
// 1.7 % in time, 4.3 % in stress.
void add_step_load(Outcome& outcome) {
  const Case input = case_of("scenes/step_load");
  const Result result = simulate(input);
  const auto peak = std::ranges::max_element(result.history, {}, &HistoryRow::struck_displacement);
  const auto largest = std::ranges::max_element(result.history, {}, &HistoryRow::back_stress);
  const auto add = [&](const char* what, double published, double ours, double tolerance) {
    outcome.rows.push_back(
        {std::string("NAFEMS 5T: ") + what, published, ours, Bound::relative, tolerance});
  };
  add("largest displacement, mm", 1.043, 1e3 * peak->struck_displacement, 0.013);
  add("its time, s", 0.0117, peak->time, 0.017);
  add("largest stress, MPa", 18.76, 1e-6 * largest->back_stress, 0.043);
  const Case still = case_of("scenes/step_load", {"beam.start=equilibrium", "time.end=1e-3"});
  add("static displacement, mm", 0.538, 1e3 * simulate(still).history.front().struck_displacement,
      0.013);
}

// SDNL32 by a stop, beside its heavy striker.
void add_stop(Outcome& outcome) {
  const Result striker = simulate(case_of("sdnl32"));
  const Result stop =
      simulate(case_of("sdnl32", {"striker.fixed=true", "striker.mass=default",
                                  "striker.velocity=default", "beam.angular_velocity=-3.8"}));
  const auto tip = [](const Result& result, double time) {
    const auto row = std::ranges::min_element(
        result.history, {}, [time](const HistoryRow& at) { return std::abs(at.time - time); });
    return -1e3 * row->indentation;
  };
  for (int ms = 1; ms <= 12; ++ms) {
    outcome.rows.push_back({fmt::format("SDNL32 by a stop: tip at {} ms, mm, against its heavy "
                                        "striker",
                                        ms),
                            tip(striker, 1e-3 * ms), tip(stop, 1e-3 * ms), Bound::absolute,
                            4.9e-3});
  }
}

// A mass falls on a plane: times of the first touch, of separation and of the second touch.
void add_drop(Outcome& outcome) {
  const double g = 9.81, v0 = 0.3, gap = 2e-3, k = 1e6, m = 0.2;
  const double v1 = std::sqrt(v0 * v0 + 2.0 * g * gap), w = std::sqrt(k / m);
  const double touch = (v1 - v0) / g;
  const double lasts = 2.0 * (std::numbers::pi - std::atan(v1 * w / g)) / w;
  for (const std::string& method : methods) {
    const Result result = simulate(case_of(
        "scenes", {"beam.springs=[]", "beam.velocity=0", "beam.fixed=true", "striker.fixed=false",
                   fmt::format("striker.mass={}", m), fmt::format("striker.velocity={}", v0),
                   fmt::format("striker.gap={}", gap), fmt::format("scene.gravity={}", g),
                   "time.end=0.15", "solver.method=" + method}));
    const auto add = [&](const char* what, double expected, double ours) {
      outcome.rows.push_back({fmt::format("drop on a plane, {}: {}, s", method, what), expected,
                              ours, Bound::relative, 1e-9});
    };
    add("touch", touch, result.sub_impacts.at(0).start);
    add("separation", touch + lasts, result.sub_impacts.at(0).end.value());
    add("next touch", touch + lasts + 2.0 * v1 / g, result.sub_impacts.at(1).start);
  }
}

// The mass of SDND101 with a gap: two frequencies.
void add_spring(Outcome& outcome) {
  const double mass = 100.0, spring = 1e4, k = 1e6, v = 1.0, gap = 0.05;
  const double slow = std::sqrt(spring / mass), fast = std::sqrt((spring + k) / mass);
  const double touch = std::asin(gap * slow / v) / slow;
  const double v1 = std::sqrt(v * v - slow * slow * gap * gap);
  const double lasts = 2.0 / fast * std::atan(v1 / (fast * gap * spring / (k + spring)));
  for (const std::string& method : methods) {
    const Result result = simulate(case_of(
        "scenes", {fmt::format("striker.gap={}", gap), "time.end=0.6", "solver.method=" + method}));
    const auto add = [&](const char* what, double expected, double ours) {
      outcome.rows.push_back({fmt::format("on a spring against a stop, {}: {}, s", method, what),
                              expected, ours, Bound::relative, 1e-9});
    };
    add("touch", touch, result.sub_impacts.at(0).start);
    add("separation", touch + lasts, result.sub_impacts.at(0).end.value());
    add("next touch", touch + lasts + (std::numbers::pi + 2.0 * std::asin(gap * slow / v)) / slow,
        result.sub_impacts.at(1).start);
  }
}

// Bedded beam, beam under its weight: order of the mesh.
void add_beams(Outcome& outcome) {
  for (const auto& [mesh, tolerance] : {std::pair("cells", 1e-4), std::pair("hermite", 1e-7)}) {
    const std::string of_mesh = std::string("model.mesh=") + mesh;
    Case input = case_of("scenes/step_load",
                         {"beam.theory=rayleigh", "beam.poisson=default", of_mesh,
                          "model.segments=501", "model.elements=100", "beam.damping.ratio=0",
                          "beam.thickness=0.2", "beam.foundation=1e7", "beam.load=0"});
    const Beam& beam = input.scene.beam;
    const auto modes = problem_of(input).mesh->natural_modes(beam.bending_stiffness());
    for (int n = 0; n < 3; ++n) {
      const double b = (2 * n + 1) * std::numbers::pi / beam.length;
      const double squared = (beam.bending_stiffness() * std::pow(b, 4) + beam.foundation) /
                             (beam.mass_per_length() + beam.rotary_inertia() * b * b);
      outcome.rows.push_back({fmt::format("bedded beam, {}: frequency {}, rad/s", mesh, 2 * n + 1),
                              std::sqrt(squared), modes.frequencies[static_cast<std::size_t>(n)],
                              Bound::relative, (2 * n + 1) * tolerance});
    }
    const Case still = case_of(
        "scenes/step_load",
        {"beam.theory=euler-bernoulli", "beam.poisson=default", of_mesh, "model.segments=501",
         "model.elements=100", "beam.damping.ratio=0", "beam.load=0", "scene.gravity=9.81",
         "beam.start=equilibrium", "time.end=1e-3", "beam.thickness=0.2"});
    const Beam& at_rest = still.scene.beam;
    const double weight = at_rest.mass_per_length() * 9.81;
    outcome.rows.push_back(
        {fmt::format("beam under its weight, {}: displacement, mm", mesh),
         1e3 * 5.0 * weight * std::pow(at_rest.length, 4) / (384.0 * at_rest.bending_stiffness()),
         1e3 * simulate(still).history.front().struck_displacement, Bound::relative,
         std::string(mesh) == "cells" ? 1e-4 : 1e-9});
  }
}

}  // namespace

Outcome check_scenes() {
  Outcome outcome{"code_aster, NAFEMS, closed form", {}, {}};
  add_sdnd101(outcome);
  add_step_load(outcome);
  add_stop(outcome);
  add_drop(outcome);
  add_spring(outcome);
  add_beams(outcome);
  return outcome;
}

}  // namespace subimpact::validation
