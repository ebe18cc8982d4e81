// The advice of plan() on random scenes and on the paper's beam: whether it meets the tolerance up
// to its horizon, and what it costs compared with the cheapest setting.

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "study/parallel.h"
#include "subimpact/io/case_file.h"
#include "subimpact/study/other_mesh.h"
#include "subimpact/study/plan.h"
#include "within/judging.h"

namespace subimpact::wishes {
namespace {

constexpr double us = 1e6;
constexpr double wishes[] = {10e-6, 1e-6, 0.1e-6};
constexpr double near_cheapest = 1.5;

struct Request {
  std::string scene;
  Case input;
  double wish = 0.0;
  Plan plan;
  std::string refusal;        // why there is no plan
  std::size_t n_judged = 0;   // sub-impacts before the horizon that the truth knows
  double error = 0.0;         // s, true one, of the advised run
  double cheapest = 0.0;      // counted work
  double of_plan = 0.0;       // counted work of all runs but the reference's, over the advised
  double of_reference = 0.0;  // counted work of the reference, over the advised

  bool advised() const { return plan.cheapest.has_value(); }
  const PlanPoint& advice() const { return plan.points[*plan.cheapest]; }
  double ratio() const { return cheapest > 0.0 ? advice().counted / cheapest : 0.0; }
};

bool same_sequence(const Case& a, const Case& b) {
  return a.model.mesh == b.model.mesh && a.solver.method == b.solver.method &&
         a.model.strike_refinement == b.model.strike_refinement;
}

// Over all sequences that the plan has tried, each from its own finest mesh on.
double cheapest_of(const Plan& plan, const Reference& truth, std::size_t n, double wish) {
  double cheapest = 0.0;
  const auto& points = plan.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i + 1 < points.size() && same_sequence(points[i].input, points[i + 1].input)) continue;
    const double work =
        cheapest_work(sequence_of(points[i].input, plan.reference.horizon), truth, n, wish);
    if (work > 0.0 && (cheapest == 0.0 || work < cheapest)) cheapest = work;
  }
  return cheapest;
}

void judge(Request& request) {
  try {
    request.plan = plan(request.input, request.wish);
  } catch (const InvalidCase& error) {
    request.refusal = error.key + " " + error.what();
    return;
  }
  const Plan& plan = request.plan;
  if (!plan.cheapest) {
    request.refusal = "no mesh is within the tolerance together with all finer ones";
    return;
  }
  const Reference truth = reference_of(plan.reference.input, 2.0);
  request.n_judged = std::min(n_judged(truth, request.wish), plan.reference.sub_impacts.size());
  const PlanPoint& advice = request.advice();
  request.error = error_of(simulate(advice.input).sub_impacts, truth, request.n_judged);
  request.cheapest = cheapest_of(plan, truth, request.n_judged, request.wish);
  for (const PlanPoint& point : plan.points) request.of_plan += point.counted / advice.counted;
  request.of_reference = counted_work(plan.reference.result) / advice.counted;
}

// With the default limit of work.
Case papers_beam() {
  Case input = read_case_file(SUBIMPACT_PAPER_CASE).value;
  input.model.section = SectionKind::exact;
  input.end_time = 0.84e-3;
  input.output.keep_no_rows();
  return input;
}

std::vector<Request> requests_of(const WishStudy& study) {
  std::vector<Request> requests(1);
  requests[0].scene = "paper";
  requests[0].input = papers_beam();
  requests[0].wish = 0.1e-6;
  for (int number = 0; number < study.n_scenes; ++number) {
    const Case input = open_scene(study.seed, number, study.budget, study.work_limit);
    for (const double wish : wishes) {
      Request request;
      request.scene = fmt::format("{}", number);
      request.input = input;
      request.wish = wish;
      requests.push_back(std::move(request));
    }
  }
  return requests;
}

void print_row(const Request& request) {
  if (!request.advised()) {
    fmt::print("| {} | {:g} | none: {} | | | | | | |\n", request.scene, us * request.wish,
               request.refusal);
    return;
  }
  const Plan& plan = request.plan;
  fmt::print("| {} | {:g} | {}, {} | {:.1f} | {} of {} | {:.3g} | {:.2f} | {:.1f} | {:.1f} |\n",
             request.scene, us * request.wish, request.advice().mesh,
             request.advice().setting.method, us * plan.reference.horizon, request.n_judged,
             plan.reference.sub_impacts.size(), us * request.error, request.ratio(),
             request.of_plan, request.of_reference);
}

}  // namespace

int study_advice(const WishStudy& study) {
  std::vector<Request> requests = requests_of(study);
  in_parallel(requests.size(), study.jobs, [&](std::size_t i) {
    judge(requests[i]);
    fmt::print(stderr, "request {} done\n", i);
  });
  fmt::print(
      "| scene | tolerance, us | advice | horizon, us | judged | largest error, us | work over "
      "cheapest "
      "| work of the plan over the advised run's | of its reference |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  std::size_t n_advised = 0, n_met = 0, n_near = 0, n_events = 0;
  std::vector<double> of_plan, of_reference;
  for (const Request& request : requests) {
    print_row(request);
    if (!request.advised()) continue;
    ++n_advised;
    n_events += 2 * request.n_judged;
    n_met += request.error <= request.wish;
    n_near += request.ratio() > 0.0 && request.ratio() <= near_cheapest;
    of_plan.push_back(request.of_plan);
    of_reference.push_back(request.of_reference);
  }
  fmt::print(
      "\n{} requests, {} with advice; of these {} meet the tolerance ({} event times judged), {} "
      "within "
      "{} times the cheapest; work of the plan over that of the advised run, median: {:.1f}, and "
      "{:.1f} of the last run of the reference\n",
      requests.size(), n_advised, n_met, n_events, n_near, near_cheapest, median(of_plan),
      median(of_reference));
  return n_met < n_advised ? 1 : 0;
}

}  // namespace subimpact::wishes
