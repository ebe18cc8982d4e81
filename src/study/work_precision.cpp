#include "subimpact/study/work_precision.h"

#include <fmt/format.h>

#include <algorithm>

#include "case/counted.h"
#include "subimpact/study/match.h"

namespace subimpact {
namespace {

// Error of the reference over the finest error with a recommendation, at most.
constexpr double reference_share = 0.1;
// A tolerance ten times tighter costs up to this many times more (order 3: 2.2).
constexpr double growth_of_a_decade = 2.2;

struct TimedRun {
  Result result;
  double seconds = 0.0;  ///< wall time, set-up included: the shortest of the repeats
  int repeats = 0;
};

// Runs the case once to warm up (the result of that run is returned), then again until the options'
// number of repeats or budget is reached; a first run that uses up the budget alone is the timed
// one. Nothing else should run on the machine meanwhile. Throws InvalidCase.
TimedRun timed_run(const Case& input, const WorkPrecisionOptions& options) {
  TimedRun run;
  run.result = simulate(input, options.progress);
  run.seconds = run.result.work.wall_seconds;
  run.repeats = 1;
  if (!run.result.outcome.completed()) return run;
  double total = run.seconds;
  for (int i = 0; i < options.most_repeats && total < options.timing_budget; ++i) {
    const Result again = simulate(input, options.progress);
    if (again.outcome.kind == OutcomeKind::stopped) {
      run.result.outcome = again.outcome;  // a timing cut short is none
      return run;
    }
    const double seconds = again.work.wall_seconds;
    total += seconds;
    run.seconds = i == 0 ? seconds : std::min(run.seconds, seconds);
    run.repeats = i + 1;
  }
  return run;
}

void conclude(WorkPrecisionPoint& point, const TimedRun& run, const Reference& reference) {
  point.work = run.result.work;
  point.seconds = run.seconds;
  point.repeats = run.repeats;
  point.errors = event_errors(run.result, reference);
  point.verdict = judge(run.result, point.errors);
  if (!run.result.outcome.completed()) {
    point.message =
        fmt::format("at {:.6g} us {}", 1e6 * run.result.outcome.time, run.result.outcome.message);
  } else if (point.errors.unmatched) {
    point.message = fmt::format(
        "{} of {}, {}; {}", counted(point.errors.n_found, "sub-impact"), point.errors.n_reference,
        leading_words(point.errors.n_corresponding), point.errors.unmatched->description);
  }
}

// Whether every finer setting of the method reaches the error too; points get finer.
bool finer_ones_reach(const std::vector<WorkPrecisionPoint>& points, std::size_t from,
                      double error) {
  for (std::size_t i = from + 1; i < points.size(); ++i) {
    const bool finer = points[i].setting.method == points[from].setting.method &&
                       points[i].verdict != Verdict::not_run;
    if (finer && !points[i].reaches(error)) return false;
  }
  return true;
}

class Study {
 public:
  Study(const Case& input, const WorkPrecisionOptions& options) : options_(options) {
    std::vector<std::string> methods = options.methods;
    if (methods.empty()) methods = default_methods(input);
    for (const std::string& method : methods) sweeps_.push_back(settings_of(input, method));
    announce("reference");
    study_.reference =
        compute_reference(input, reference_share * recommended_errors().back(), options.progress);
    if (study_.reference.result.outcome.kind == OutcomeKind::stopped) study_.interrupted = true;
    compared_ = input;
    compared_.end_time = study_.reference.horizon;
  }

  WorkPrecision run() {
    for (const std::vector<Setting>& sweep : sweeps_) {
      if (!study_.interrupted) run_sweep(sweep);
    }
    return std::move(study_);
  }

 private:
  void announce(const std::string& what) {
    if (options_.announce) options_.announce(what);
  }

  void run_sweep(const std::vector<Setting>& sweep) {
    double expected = 0.0;
    for (const Setting& setting : sweep) {
      WorkPrecisionPoint point;
      point.setting = setting;
      const auto known = options_.known ? options_.known(setting) : std::nullopt;
      if (known) {
        point = *known;
      } else if (expected > options_.point_seconds) {
        point.message = fmt::format("would take about {:.2g} s, more than the {:.2g} s allowed",
                                    expected, options_.point_seconds);
      } else if (!run_point(point)) {
        return;
      }
      if (!known && options_.finished) options_.finished(point);
      study_.points.push_back(point);
      if (point.verdict == Verdict::not_run) return;
      const bool as_good_as_reference =
          point.verdict == Verdict::right && point.errors.maximum < study_.reference.error;
      if (as_good_as_reference) return;
      expected = point.seconds * growth_of_a_decade;
    }
  }

  // False if interrupted.
  bool run_point(WorkPrecisionPoint& point) {
    announce(point.setting.method + " at " + point.setting.text());
    try {
      const TimedRun run = timed_run(with_setting(compared_, point.setting), options_);
      if (run.result.outcome.kind == OutcomeKind::stopped) {
        study_.interrupted = true;
        return false;
      }
      conclude(point, run, study_.reference);
    } catch (const InvalidCase& error) {
      point.verdict = Verdict::refused;
      point.message = error.key + " " + error.what();
    }
    return true;
  }

  const WorkPrecisionOptions& options_;
  std::vector<std::vector<Setting>> sweeps_;
  Case compared_;
  WorkPrecision study_;
};

}  // namespace

const std::vector<double>& recommended_errors() {
  static const std::vector<double> errors = {1e-6, 1e-7, 1e-8, 1e-9};
  return errors;
}

WorkPrecision work_precision(const Case& input, const WorkPrecisionOptions& options) {
  return Study(input, options).run();
}

std::vector<Recommendation> recommendations_from(const std::vector<WorkPrecisionPoint>& points) {
  std::vector<Recommendation> list;
  for (const double wanted : recommended_errors()) {
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

std::optional<double> error_growth(const std::vector<WorkPrecisionPoint>& points) {
  std::vector<double> ratios;
  for (const WorkPrecisionPoint& point : points) {
    if (point.verdict != Verdict::right || !(point.errors.first > 0.0)) continue;
    ratios.push_back(point.errors.last / point.errors.first);
  }
  if (ratios.empty()) return std::nullopt;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return *middle;
}

}  // namespace subimpact
