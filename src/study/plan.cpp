#include "subimpact/study/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "case/meshes.h"
#include "case/problem.h"
#include "simulate/methods.h"
#include "study/method_choice.h"
#include "study/refinement.h"
#include "subimpact/study/mesh_error_bars.h"

namespace subimpact {
namespace {

// Wished error of the reference over the wanted one.
constexpr double reference_share = 0.2;
constexpr int enough_in_a_row = 3;
constexpr double most_work_over_cheapest = 4.0;
constexpr double grading = 4.0;  // length of far elements over that of those at the strike

struct Family {
  MeshKind mesh;
  double refinement;  // at the strike
  Method method;

  bool operator==(const Family&) const = default;
};

std::vector<Family> families_without_damping(const Case& input) {
  if (may_yield(input)) {
    return {{MeshKind::cells, 1.0, Method::central_difference},
            {MeshKind::hermite, 1.0, Method::nystrom},
            {MeshKind::hermite, grading, Method::nystrom}};
  }
  return {{MeshKind::hermite, 1.0, Method::exponential},
          {MeshKind::hermite, grading, Method::exponential},
          {MeshKind::cells, 1.0, Method::exponential},
          {MeshKind::cells, 1.0, Method::central_difference}};
}

std::vector<Family> families_of(const Case& input) {
  std::vector<Family> families = families_without_damping(input);
  for (Family& family : families) family.method = method_for_damping(input, family.method);
  families.erase(std::unique(families.begin(), families.end()), families.end());
  return families;
}

std::string mesh_words(const Case& input) {
  const auto& refinement = *descriptor_of(input.model.mesh).refinement;
  std::string words = fmt::format("{} {}", mesh_count(input), refinement.parts);
  if (input.model.strike_refinement != 1.0) {
    words += fmt::format(", {:g} times as fine at the strike", input.model.strike_refinement);
  }
  return words;
}

// The reference, its leading sub-impacts that are decided and within its own wish, and the horizon
// in the middle of the separation that follows.
void find_reference(Plan& plan, const Case& input, const WithinOptions& how) {
  Case wished = input;
  wished.model = {};
  wished.model.section = input.model.section;
  wished.model.layers = input.model.layers;
  wished.solver = {};
  wished.parts.mesh = nullptr;
  wished.output.keep_no_rows();
  wished.accuracy.event_times = reference_share * plan.wanted;
  plan.reference = simulate_within(wished, {}, how);
  const Result& result = plan.reference.result;
  const auto& all = result.sub_impacts;
  const WishOutcome& wish = result.wish.value();
  const auto is_within = [&](const SubImpact& s) { return s.start < wish.horizon; };
  plan.sub_impacts.assign(all.begin(), std::ranges::partition_point(all, is_within));
  plan.reference_error = wish.reached;
  plan.horizon = input.end_time;
  plan.horizon_reason = "the case's end";
  const std::size_t n = plan.sub_impacts.size();
  if (n < all.size() && n > 0) {
    plan.horizon = 0.5 * (plan.sub_impacts.back().end.value() + all[n].start);
    plan.horizon_reason = wish.reason;
  }
  if (plan.interrupted || (n > 0 && (n > 1 || plan.sub_impacts.front().end))) return;
  throw InvalidCase(
      "time.end",
      fmt::format("is {} s, up to which no event time is known to {:.2g} us: {}; use "
                  "a later end, a larger error, or more accuracy.work_limit",
                  input.end_time, 1e6 * reference_share * plan.wanted,
                  wish.reason.empty() ? "the first contact lasts to the end" : wish.reason));
}

class Planner {
 public:
  Planner(Plan& plan, const std::function<void(const std::string&)>& announce,
          const Progress& progress)
      : plan_(plan), announce_(announce), progress_(progress) {}

  void run(const Family& family);

 private:
  bool run_point(const Case& input);
  void admit(std::size_t first);

  Plan& plan_;
  const std::function<void(const std::string&)>& announce_;
  const Progress& progress_;
};

// False if interrupted.
bool Planner::run_point(const Case& input) {
  PlanPoint point;
  point.input = input;
  point.mesh = mesh_words(input);
  point.method = descriptor_of(input.solver.method).name;
  if (announce_) announce_(point.mesh + ", " + point.method);
  const auto start = std::chrono::steady_clock::now();
  const Result result = simulate(input, progress_);
  point.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (result.outcome.kind == OutcomeKind::stopped) return false;
  point.errors = event_errors(result.sub_impacts, plan_.sub_impacts);
  point.verdict = judge(result, point.errors);
  point.work = counted_work(result);
  point.within = point.verdict == Verdict::right &&
                 point.errors.maximum + plan_.reference_error <= plan_.wanted;
  plan_.points.push_back(std::move(point));
  return true;
}

// Admits the runs from `first` on that are within together with all finer ones.
void Planner::admit(std::size_t first) {
  auto& points = plan_.points;
  std::size_t n = points.size();
  while (n > first && points[n - 1].within) points[--n].admitted = true;
  if (n + 2 > points.size()) {  // a single run proves nothing
    for (std::size_t i = n; i < points.size(); ++i) points[i].admitted = false;
    return;
  }
  if (!plan_.cheapest || points[n].work < points[*plan_.cheapest].work) plan_.cheapest = n;
}

void Planner::run(const Family& family) {
  Case base = plan_.reference.input;
  base.model.mesh = family.mesh;
  base.model.strike_refinement = family.refinement;
  base.solver = {};
  base.solver.method = family.method;
  base.end_time = plan_.horizon;
  const std::size_t first = plan_.points.size();
  int in_a_row = 0;
  try {
    const Refinement refinement(base, {});
    std::optional<Case> next = refinement.first();
    while (next && in_a_row < enough_in_a_row) {
      if (!run_point(*next)) {
        plan_.interrupted = true;
        return;
      }
      in_a_row = plan_.points.back().within ? in_a_row + 1 : 0;
      const double most = plan_.cheapest
                              ? most_work_over_cheapest * plan_.points[*plan_.cheapest].work
                              : plan_.reference.input.accuracy.work_limit;
      if (plan_.points.back().work > most) break;
      next = refinement.finer(*next, std::sqrt(2.0));
    }
  } catch (const InvalidCase&) {  // a mesh on which the scene cannot be struck
  }
  admit(first);
}

}  // namespace

Plan plan(const Case& input, double wanted, const std::function<void(const std::string&)>& announce,
          const Progress& progress) {
  Plan result;
  result.wanted = wanted;
  WithinOptions how;
  if (announce) how.announce = [&](const std::string& what) { announce("reference: " + what); };
  how.progress = [&](double time) {
    if (progress && !progress(time)) result.interrupted = true;
    return !result.interrupted;
  };
  find_reference(result, input, how);
  if (result.interrupted) return result;
  Planner planner(result, announce, progress);
  for (const Family& family : families_of(input)) {
    planner.run(family);
    if (result.interrupted) break;
  }
  return result;
}

}  // namespace subimpact
