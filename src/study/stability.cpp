#include "subimpact/study/studies.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "study/method_choice.h"
#include "study/parallel.h"

namespace subimpact {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double reference_error = 1e-10;  // s
constexpr double angles[] = {0.25, 0.5, 1.0, 1.9, 2.1, 3.0, 4.0, 5.8, 6.2, 8.0, 16.0, 32.0, 64.0};
constexpr double tolerances[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9};

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
  Case free = with_method(input, "erk");
  free.solver.step.reset();
  const double highest_frequency = resolve(free).settings().highest_frequency;
  std::vector<OutcomePoint> points;
  for (const MapRow& row : rows_of_map()) {
    if (!asked_for(methods, row.method)) continue;
    Case chosen = with_method(input, row.method);
    chosen.solver.step.reset();
    if (!can_run(chosen)) continue;
    if (row.fixed_step) chosen.study.beyond_critical = row.forced;
    if (row.max_order) chosen.solver.max_order = row.max_order;
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

}  // namespace subimpact
