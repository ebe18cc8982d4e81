#include "subimpact/study/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <span>

#include "case/counted.h"
#include "study/method_choice.h"
#include "study/parallel.h"

namespace subimpact {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double reference_error = 1e-10;  // s
constexpr double angles[] = {0.25, 0.5, 1.0, 1.9, 2.1, 3.0, 4.0, 5.8, 6.2, 8.0, 16.0, 32.0, 64.0};
constexpr double tolerances[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9};
constexpr double steps_us[] = {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0};
constexpr int n_speeds = 40;
constexpr double tolerance_of_layers = 1e-10;
constexpr int layer_counts[] = {10, 20, 40, 80, 160, 320, 640};

/// A row of the map: a method against fixed steps, or against tolerances.
struct MapRow {
  std::string name, method;
  bool fixed_step = false;
  bool forced = false;  // beyond the critical step
  std::optional<int> max_order;
};

std::vector<MapRow> rows_of_map() {
  std::vector<MapRow> rows = {{"central-difference", "central-difference", true, false, {}},
                              {"central-difference, forced", "central-difference", true, true, {}}};
  for (const char* method : {"nystrom:dprkn8", "nystrom:dprkn12", "erk:dormand-prince",
                             "erk:dop853", "erk:dop853+library", "exponential", "dirk:esdirk547",
                             "dirk:esdirk547+library", "dirk:ark324", "dirk:trbdf2"}) {
    rows.push_back({method, method, true, false, {}});
  }
  for (const char* method :
       {"nystrom:dprkn8", "erk:dormand-prince", "erk:dop853", "erk:dop853+library", "exponential",
        "dirk:esdirk547", "adams", "adams+library"}) {
    rows.push_back({method, method, false, false, {}});
  }
  for (int order = 1; order <= 5; ++order) {
    rows.push_back({fmt::format("bdf, order up to {}", order), "bdf", false, false, order});
  }
  return rows;
}

// Points of the requested methods that can run the case at all.
std::vector<OutcomePoint> points_of(const Case& input, const std::vector<std::string>& methods) {
  const double highest_frequency = resolve(with_method(input, "erk")).settings().highest_frequency;
  std::vector<OutcomePoint> points;
  for (const MapRow& row : rows_of_map()) {
    if (!asked_for(methods, row.method)) continue;
    Case chosen = with_method(input, row.method);
    Case without_step = chosen;
    without_step.solver.step.reset();
    if (!can_run(without_step)) continue;
    if (row.fixed_step) chosen.study.beyond_critical = row.forced;
    if (!row.fixed_step) chosen.solver.max_order = row.max_order;
    for (const double x : row.fixed_step ? std::span<const double>(angles) : tolerances) {
      if (row.fixed_step) chosen.solver.step = x / highest_frequency;
      if (!row.fixed_step) chosen.solver.rtol = x;
      OutcomePoint& point = points.emplace_back();
      point.setting.fixed_step = row.fixed_step;
      point.row = row.name;
      point.x = x;
      point.input = chosen;
    }
  }
  return points;
}

void run(OutcomePoint& point, const Reference& reference, double run_seconds) {
  point.input.end_time = reference.horizon;
  const auto start = Clock::now();
  const Result result = run_trial(point, reference, [&](double) {
    return std::chrono::duration<double>(Clock::now() - start).count() < run_seconds;
  });
  if (result.outcome.kind != OutcomeKind::stopped) return;
  point.verdict = Verdict::not_run;
  point.message = fmt::format("left out: not done after {:g} s, at {:.6g} us", run_seconds,
                              1e6 * result.outcome.time);
}

double shortest_of(const std::vector<SubImpact>& sub_impacts, double shortest) {
  for (std::size_t i = 0; i < sub_impacts.size(); ++i) {
    for (const LengthBeside& beside : lengths_beside(sub_impacts, i)) {
      shortest = std::min(shortest, beside.length);
    }
  }
  return shortest;
}

}  // namespace

bool asked_for(const std::vector<std::string>& methods, const std::string& method) {
  if (methods.empty()) return true;
  return std::any_of(methods.begin(), methods.end(), [&](const std::string& asked) {
    return asked == method || method.rfind(asked + ":", 0) == 0 ||
           method.rfind(asked + "+", 0) == 0;
  });
}

OutcomeMap outcome_map(const Case& input, const std::vector<std::string>& methods,
                       double run_seconds, Jobs jobs, const Count& progress) {
  OutcomeMap map;
  map.reference = compute_reference(input, reference_error, {}, jobs == 0 ? 2 : jobs);
  map.points = points_of(input, methods);
  for (OutcomePoint& point : map.points) point.message = "left out: interrupted";
  const auto run_point = [&](std::size_t i) {
    map.points[i].message.clear();
    run(map.points[i], map.reference, run_seconds);
  };
  in_parallel(map.points.size(), jobs, run_point, progress);
  return map;
}

std::vector<MissedPairs> missed_pairs(const Case& input, Jobs jobs, const Count& progress) {
  std::vector<MissedPairs> rows;
  for (const double step : steps_us) rows.push_back({1e-6 * step, 0, 0, 0, input.end_time});
  std::vector<std::vector<MissedPairs>> of_speed(n_speeds);
  const auto run_speed = [&](std::size_t k) {
    of_speed[k] = rows;
    Case scene = with_method(input, "exponential");
    scene.model.section = SectionKind::elastic;
    scene.scene.striker.velocity *= 0.5 + static_cast<double>(k) / (n_speeds - 1);
    const Reference reference = compute_reference(scene, reference_error, {}, 1);
    scene.end_time = reference.horizon;
    for (MissedPairs& row : of_speed[k]) {
      scene.solver.step = row.step;
      for (const bool search : {true, false}) {
        scene.study.pair_detection = search;
        const Result result = simulate(scene);
        const bool right = judge(result, event_errors(result, reference)) == Verdict::right;
        (search ? row.right_with_search : row.right_without) = right ? 1 : 0;
      }
      row.shortest = shortest_of(reference.sub_impacts, reference.horizon);
    }
  };
  in_parallel(n_speeds, jobs, run_speed, progress);
  std::erase_if(of_speed, [](const auto& speed) { return speed.empty(); });  // interrupted
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const std::vector<MissedPairs>& speed : of_speed) {
      ++rows[i].n_runs;
      rows[i].right_with_search += speed[i].right_with_search;
      rows[i].right_without += speed[i].right_without;
      rows[i].shortest = std::min(rows[i].shortest, speed[i].shortest);
    }
  }
  return rows;
}

LayerStudy layers_against_exact(const Case& input, Jobs jobs, const Count& progress) {
  LayerStudy study;
  Case exact = input;
  exact.model.section = SectionKind::exact;
  study.exact = compute_reference(exact, reference_error, {}, jobs == 0 ? 2 : jobs);
  std::vector<std::optional<LayerPoint>> points(std::size(layer_counts));
  const auto run_layers = [&](std::size_t i) {
    Case trial = with_method(study.exact.input, "nystrom");
    trial.solver.rtol = tolerance_of_layers;
    trial.model.section = SectionKind::layers;
    trial.model.layers = layer_counts[i];
    points[i] = {layer_counts[i], event_errors(simulate(trial), study.exact)};
  };
  in_parallel(points.size(), jobs, run_layers, progress);
  for (std::optional<LayerPoint>& point : points) {
    if (point) study.points.push_back(std::move(*point));  // not interrupted
  }
  return study;
}

}  // namespace subimpact
