// Hermite elements against cells on a beam that stays elastic, at one total error.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>

#include "parts.h"
#include "subimpact/study/judgement/event_errors.h"

namespace subimpact::benchmarks {
namespace {

constexpr double horizon = 0.84e-3;    // s: nine sub-impacts
constexpr int rounds_for_one = 5;      // times the rounds asked for, for the ratios printed
constexpr double wanted_error = 5e-8;  // s, of every start and end, mesh and time together

Case on_mesh(MeshKind mesh, int count) {
  Case input = paper_case(SectionKind::elastic);
  input.end_time = horizon;
  input.model.mesh = mesh;
  (mesh == MeshKind::cells ? input.model.segments : input.model.elements) = count;
  return input;
}

struct Setting {
  Case input;
  double error;  // s
  long right_hand_sides;
  double work;  // right-hand sides times unknowns
};

// The settings of a method in time, loosest first.
std::vector<Case> settings_of(Method method, const Case& on_this_mesh) {
  std::vector<Case> cases;
  Case input = on_this_mesh;
  input.solver.method = method;
  if (method == Method::central_difference) {
    const double critical = resolve(input).settings().critical_step;
    for (double part = 0.95; part > 0.02; part *= 0.85) {
      input.solver.step = part * critical;
      cases.push_back(input);
    }
    return cases;
  }
  for (double exponent = -4.0; exponent > -10.0; exponent -= 0.5) {
    input.solver.rtol = std::pow(10.0, exponent);
    cases.push_back(input);
  }
  return cases;
}

// The cheapest setting in mesh and time together that comes within the wanted error: on every mesh
// the loosest in time that does, of those, timed side by side, the one that takes least time.
std::optional<Setting> cheapest(const Settings& settings, Method method, MeshKind mesh,
                                const std::vector<int>& counts,
                                const std::vector<SubImpact>& limit) {
  std::vector<Setting> good;
  for (const int count : counts) {
    for (const Case& input : settings_of(method, on_mesh(mesh, count))) {
      const Result result = simulate(input);
      if (!result.outcome.completed()) continue;
      const EventErrors errors = event_errors(result.sub_impacts, limit);
      if (errors.overall() > wanted_error) continue;
      const long evaluations = result.work.right_hand_sides;
      good.push_back(
          {input, errors.overall(), evaluations,
           static_cast<double>(evaluations) * static_cast<double>(result.used.n_unknowns)});
      break;
    }
  }
  if (good.empty()) return std::nullopt;
  // What takes far more evaluations of more unknowns than another need not be timed. (The
  // exponential method hardly evaluates.)
  if (method != Method::exponential) {
    double least_work = good.front().work;
    for (const Setting& setting : good) least_work = std::min(least_work, setting.work);
    std::erase_if(good, [&](const Setting& of) { return of.work > 1.5 * least_work; });
  }
  std::vector<std::function<void()>> runs;
  for (const Setting& setting : good) runs.push_back([&] { run_to_end(setting.input); });
  const std::vector<double> seconds = seconds_side_by_side(settings, runs);
  const auto least = std::min_element(seconds.begin(), seconds.end()) - seconds.begin();
  return good[static_cast<std::size_t>(least)];
}

std::string setting_text(const Setting& setting) {
  const Case& input = setting.input;
  const bool cells = input.model.mesh == MeshKind::cells;
  const std::string mesh = cells ? fmt::format("{} cells", input.model.segments)
                                 : fmt::format("{} elements", input.model.elements);
  return input.solver.step ? fmt::format("{}, step {:.3g} us", mesh, 1e6 * *input.solver.step)
                           : fmt::format("{}, rtol {:.1e}", mesh, input.solver.rtol);
}

}  // namespace

void measure_mesh(const Settings& settings) {
  Case finest = on_mesh(MeshKind::hermite, 800);
  finest.solver.method = Method::exponential;
  finest.solver.rtol = 1e-11;
  const std::vector<SubImpact> limit = run_to_end(finest).sub_impacts;
  fmt::print(
      "{:.2f} ms, section elastic, {} sub-impacts, every start and end within {:.2f} us of 800 "
      "elements;\nseconds include set-up.\n\n{:20} {:28} {:>12} {:>14} {:>10} {:>7}\n",
      1e3 * horizon, limit.size(), 1e6 * wanted_error, "method", "cheapest setting", "error, us",
      "right-h. sides", "s", "ratio");
  // Between 0.05 us and what these meshes leave lies the room for an error in time.
  const std::vector<int> cells{2081, 2101, 2151, 2201, 2401, 2829, 3401, 4001};
  const std::vector<int> elements{214, 216, 224, 240, 256, 272, 280, 320};
  // A run takes milliseconds: its median needs more rounds than a long run's.
  Settings final = settings;
  final.repeats = rounds_for_one * settings.repeats;
  for (const Method method : {Method::erk, Method::central_difference, Method::exponential}) {
    const auto by_cells = cheapest(settings, method, MeshKind::cells, cells, limit);
    const auto by_elements = cheapest(settings, method, MeshKind::hermite, elements, limit);
    const char* name = method == Method::erk                  ? "erk"
                       : method == Method::central_difference ? "central-difference"
                                                              : "exponential";
    if (!by_cells || !by_elements) {
      fmt::print("{:20} not reached on {}\n", name, by_cells ? "elements" : "cells");
      continue;
    }
    const std::vector<double> seconds = seconds_side_by_side(
        final, {[&] { run_to_end(by_elements->input); }, [&] { run_to_end(by_cells->input); }});
    for (std::size_t i = 0; i < 2; ++i) {
      const Setting& setting = i == 0 ? *by_elements : *by_cells;
      fmt::print("{:20} {:28} {:12.3f} {:14} {:10.5f} {:7.1f}\n", name, setting_text(setting),
                 1e6 * setting.error, setting.right_hand_sides, seconds[i],
                 seconds[i] / seconds[0]);
      std::fflush(stdout);
    }
  }
}

}  // namespace subimpact::benchmarks
