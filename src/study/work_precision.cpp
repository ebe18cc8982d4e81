#include "subimpact/study/studies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/problem.h"
#include "numerics/estimates.h"
#include "study/method_choice.h"

namespace subimpact {
namespace {

// Error of the reference over the finest error with a recommendation, at most.
constexpr double reference_share = 0.1;
// A tolerance ten times tighter costs up to this many times more (order 3: 2.2).
constexpr double growth_of_a_decade = 2.2;
// Errors show an order where they are so many times that of the reference.
constexpr double shown_order = 4.0;
constexpr double same_order = 1.25;  // of two pairs of steps in a row
constexpr double least_order = 1.5;  // below it is rounding
constexpr double whole = 0.01;       // distance of an exponent from a whole number

// Runs the case once to warm up, whose result counts, then again until the options' number of
// repeats or budget is reached; a first run that uses up the budget alone is the timed one. Nothing
// else should run on the machine meanwhile. False if interrupted: a timing cut short is none.
bool run_timed(Trial& trial, const Reference& reference, const WorkPrecisionOptions& options) {
  const Result result = run_trial(trial, reference, options.progress);
  if (result.outcome.kind == OutcomeKind::stopped) return false;
  if (!result.outcome.completed() || trial.verdict == Verdict::refused) return true;
  double total = trial.seconds;
  for (int i = 0; i < options.most_repeats && total < options.timing_budget; ++i) {
    const Result again = simulate(trial.input, options.progress);
    if (again.outcome.kind == OutcomeKind::stopped) return false;
    const double seconds = again.work.wall_seconds;
    total += seconds;
    trial.seconds = i == 0 ? seconds : std::min(trial.seconds, seconds);
    trial.repeats = i + 1;
  }
  return true;
}

// Whether every finer setting of the method reaches the error too; points get finer.
bool finer_ones_reach(const std::vector<Trial>& points, std::size_t from, double error) {
  for (std::size_t i = from + 1; i < points.size(); ++i) {
    const bool finer = points[i].setting.method == points[from].setting.method &&
                       points[i].setting.fixed_step == points[from].setting.fixed_step &&
                       points[i].verdict != Verdict::not_run;
    if (finer && !points[i].reaches(error)) return false;
  }
  return true;
}

// Of a run after one with a longer step.
std::optional<double> order_between(const Trial& longer, const Trial& point, double least) {
  const bool shows = point.setting.fixed_step && longer.verdict == Verdict::right &&
                     point.verdict == Verdict::right && longer.errors.maximum > least &&
                     point.errors.maximum > least;
  if (!shows) return std::nullopt;
  return std::log(longer.errors.rms / point.errors.rms) /
         std::log(longer.setting.value / point.setting.value);
}

// Runs settings of one kind of a method from coarse to fine, into the study; `compared` ends at the
// horizon.
void run_sweep(const Case& compared, std::span<const Setting> sweep,
               const WorkPrecisionOptions& options, WorkPrecision& study) {
  double expected = 0.0;
  std::optional<Trial> before;
  for (const Setting& setting : sweep) {
    Trial point;
    point.setting = setting;
    if (expected > options.point_seconds) {
      point.message = fmt::format("would take about {:.2g} s, more than the {:.2g} s allowed",
                                  expected, options.point_seconds);
    } else {
      if (options.announce) options.announce(setting.method + " at " + setting.text());
      point.input = with_setting(compared, setting);
      study.interrupted = !run_timed(point, study.reference, options);
      if (study.interrupted) return;
    }
    const double least = shown_order * study.reference.error;
    if (before) point.order = order_between(*before, point, least);
    before = point;
    study.points.push_back(point);
    if (options.finished) options.finished(study);
    if (point.verdict == Verdict::not_run) return;
    const bool as_good_as_reference =
        point.verdict == Verdict::right && point.errors.maximum < study.reference.error;
    if (as_good_as_reference) return;
    expected = point.seconds * growth_of_a_decade;
  }
}

// Observed where two pairs of steps in a row agree: steps too long for an order show none, nor does
// rounding.
MethodOrder order_of_sweep(const Case& compared, const Setting& fixed, const WorkPrecision& study) {
  const Case input = with_setting(compared, fixed);
  const ResolvedSettings used = resolve(input).settings();
  MethodOrder order{fixed.method, order_of(input, used), {}, OrderBound::none, {}};
  const Trial* before = nullptr;
  for (const Trial& point : study.points) {
    if (point.setting.method != fixed.method) continue;
    const bool agree = before != nullptr && before->order && point.order > least_order &&
                       std::abs(*point.order - *before->order) <= same_order;
    if (agree) order.observed = point.order;
    before = &point;
  }
  const double n = used.contact_exponent;
  const auto bound = [&](OrderBound by, std::optional<double> most) {
    if (most.value_or(0.0) >= order.smooth) return;
    if (order.most && most && *order.most <= *most) return;
    order.bound = by;
    if (most) order.most = most;
  };
  if (may_yield(input)) bound(OrderBound::sections, {});
  if (std::abs(n - std::round(n)) > whole) bound(OrderBound::contact, n + 1.0);
  if (used.events == EventHandling::interpolated) bound(OrderBound::interpolation, 3.0);
  if (used.events == EventHandling::library) bound(OrderBound::library, 5.0);
  return order;
}

}  // namespace

WorkPrecision work_precision(const Case& input, const WorkPrecisionOptions& options) {
  std::vector<std::vector<Setting>> sweeps;
  for (const std::string& method :
       options.methods.empty() ? default_methods(input) : options.methods) {
    sweeps.push_back(settings_of(input, method));
  }
  if (options.announce) options.announce("reference");
  WorkPrecision study;
  study.reference =
      compute_reference(input, reference_share * recommended_errors.back(), options.progress);
  study.interrupted = study.reference.result.outcome.kind == OutcomeKind::stopped;
  Case compared = input;
  compared.end_time = study.reference.horizon;
  for (const std::vector<Setting>& sweep : sweeps) {
    const auto fixed = std::ranges::find_if(sweep, &Setting::fixed_step);
    for (const auto& part : {std::span(sweep.begin(), fixed), std::span(fixed, sweep.end())}) {
      if (!study.interrupted) run_sweep(compared, part, options, study);
    }
    if (fixed == sweep.end() || study.interrupted) continue;
    MethodOrder order = order_of_sweep(compared, *fixed, study);
    if (order.smooth > 0) study.orders.push_back(std::move(order));
  }
  return study;
}

std::vector<Recommendation> recommendations_from(const std::vector<Trial>& points) {
  std::vector<Recommendation> list;
  for (const double wanted : recommended_errors) {
    Recommendation recommendations{wanted, {}, {}};
    std::optional<std::size_t> cheapest, steady;
    const auto take = [&](std::optional<std::size_t>& best, std::size_t i) {
      if (!best || points[i].seconds < points[*best].seconds) best = i;
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!points[i].reaches(wanted)) continue;
      take(cheapest, i);
      if (finer_ones_reach(points, i, wanted)) take(steady, i);
    }
    if (cheapest) recommendations.point = points[*cheapest];
    if (steady && steady != cheapest) recommendations.steady = points[*steady];
    list.push_back(recommendations);
  }
  return list;
}

std::optional<double> error_growth(const std::vector<Trial>& points) {
  std::vector<double> ratios;
  for (const Trial& point : points) {
    if (point.verdict != Verdict::right || !(point.errors.first > 0.0)) continue;
    ratios.push_back(point.errors.last / point.errors.first);
  }
  if (ratios.empty()) return std::nullopt;
  return median(std::move(ratios));
}

}  // namespace subimpact
