#include "subimpact/study/plan.h"

#include <algorithm>

#include "study/timed_run.h"

namespace subimpact {
namespace {

// Uncertainty of the limit over the wanted error, at most.
constexpr double limit_share = 0.2;
constexpr double timing_budget = 0.4;  // s
constexpr int most_repeats = 5;
constexpr double tightest_tolerance = 1e-10;

std::vector<std::string> fast_methods(const Case& input) {
  const std::vector<std::string> all = default_methods(input);
  std::vector<std::string> methods;
  for (const char* method : {"central-difference", "exponential", "nystrom:dprkn8", "erk:dop853"}) {
    if (std::find(all.begin(), all.end(), method) != all.end()) methods.push_back(method);
  }
  return methods;
}

// From coarse to fine, until the total error is within the wanted one; false if interrupted.
bool sweep(PlanPoint& point, const std::string& method, double wanted, const MeshLimit& limit,
           const Progress& progress) {
  for (const Setting& setting : settings_of(point.input, method)) {
    if (!setting.fixed_step && setting.value < tightest_tolerance) break;
    Case trial = with_setting(point.input, setting);
    trial.end_time = limit.horizon;
    const TimedRun run = timed_run(trial, timing_budget, most_repeats, progress);
    if (run.result.outcome.kind == OutcomeKind::stopped) return false;
    point.run.setting = setting;
    point.run.errors = event_errors(run.result.sub_impacts, limit.sub_impacts);
    point.run.verdict = judge(run.result, point.run.errors);
    point.run.work = run.result.work;
    point.run.seconds = run.seconds;
    point.run.repeats = run.repeats;
    if (point.run.reaches(wanted)) break;
  }
  return true;
}

}  // namespace

Plan plan(const Case& input, double wanted, const std::function<void(const std::string&)>& announce,
          const Progress& progress) {
  Plan result;
  result.wanted = wanted;
  if (announce) announce("meshes");
  result.limit = mesh_limit(input, limit_share * wanted);
  for (const MeshRun& mesh : result.limit.runs) {
    // No time integration mends the mesh.
    if (!mesh.errors.all_correspond() || mesh.errors.maximum > wanted) continue;
    Case base = input;
    base.model = mesh.input.model;
    base.output.interval = 0.0;
    base.solver = {};
    base.study = {};
    for (const std::string& method : fast_methods(base)) {
      if (announce) announce(mesh.mesh + ", " + method);
      PlanPoint point{base, mesh.mesh, mesh.errors.maximum, {}};
      if (!sweep(point, method, wanted, result.limit, progress)) {
        result.interrupted = true;
        return result;
      }
      result.points.push_back(point);
      const auto cheapest = result.cheapest;
      if (point.run.reaches(wanted) &&
          (!cheapest || point.run.seconds < result.points[*cheapest].run.seconds)) {
        result.cheapest = result.points.size() - 1;
      }
    }
  }
  return result;
}

}  // namespace subimpact
