#include <fmt/format.h>

#include <chrono>
#include <mutex>
#include <optional>
#include <span>

#include "case/counted.h"
#include "study/method_choice.h"
#include "study/parallel.h"
#include "subimpact/study/stability.h"

namespace subimpact {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double reference_error = 1e-10;  // s
constexpr double angles[] = {0.25, 0.5, 1.0, 1.9, 2.1, 3.0, 4.0, 5.8, 6.2, 8.0, 16.0, 32.0, 64.0};
constexpr double tolerances[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9};

struct Trial {
  OutcomePoint point;
  Case input;
};

class Trials {
 public:
  Trials(const Case& input, const std::vector<std::string>& methods)
      : input_(input), methods_(methods) {
    highest_frequency_ = resolve(with_method(input, "erk")).settings().highest_frequency;
  }

  void add_steps(const std::string& row, const std::string& method, bool forced = false) {
    add("fixed step", row, method, angles, [&](Case& chosen, double angle) {
      chosen.study.beyond_critical = forced;
      chosen.solver.step = angle / highest_frequency_;
    });
  }

  void add_tolerances(const std::string& row, const std::string& method,
                      std::optional<int> max_order = {}) {
    add("tolerance", row, method, tolerances, [&](Case& chosen, double rtol) {
      chosen.solver.max_order = max_order;
      chosen.solver.rtol = rtol;
    });
  }

  std::vector<Trial> list;

 private:
  // One trial per x, in a row of its own, if the method can run the case at all.
  template <class Set>
  void add(const char* group, const std::string& row, const std::string& method,
           std::span<const double> all, Set set) {
    if (!asked_for(methods_, method)) return;
    Case chosen = with_method(input_, method);
    Case without_step = chosen;
    without_step.solver.step.reset();
    if (!can_run(without_step)) return;
    for (const double x : all) {
      set(chosen, x);
      list.push_back({{}, chosen});
      list.back().point.group = group;
      list.back().point.row = row;
      list.back().point.x = x;
    }
  }

  Case input_;
  const std::vector<std::string>& methods_;
  double highest_frequency_;
};

std::vector<Trial> all_trials(const Case& input, const std::vector<std::string>& methods) {
  Trials trials(input, methods);
  trials.add_steps("central-difference", "central-difference");
  trials.add_steps("central-difference, forced", "central-difference", true);
  for (const char* method :
       {"nystrom:dprkn8", "nystrom:dprkn12", "erk:dormand-prince", "erk:dop853",
        "erk:dop853+library", "exponential", "dirk:esdirk547", "dirk:esdirk547+library",
        "dirk:ark324", "dirk:trbdf2", "imex:ark437"}) {
    trials.add_steps(method, method);
  }
  for (const char* method :
       {"nystrom:dprkn8", "erk:dormand-prince", "erk:dop853", "erk:dop853+library", "exponential",
        "dirk:esdirk547", "imex:ark437", "adams", "adams+library"}) {
    trials.add_tolerances(method, method);
  }
  for (int order = 1; order <= 5; ++order) {
    trials.add_tolerances(fmt::format("bdf, order up to {}", order), "bdf", order);
  }
  return std::move(trials.list);
}

void run(Trial& trial, const Reference& reference, double run_seconds) {
  OutcomePoint& point = trial.point;
  trial.input.end_time = reference.horizon;
  const auto start = Clock::now();
  try {
    const Result result = simulate(trial.input, [&](double) {
      return std::chrono::duration<double>(Clock::now() - start).count() < run_seconds;
    });
    point.errors = event_errors(result, reference);
    point.energy_error = result.max_energy_error;
    point.verdict = judge(result, point.errors);
    if (result.outcome.kind == OutcomeKind::stopped) {
      point.verdict = Verdict::not_run;
      point.message = fmt::format("left out: not done after {:g} s, at {:.6g} us", run_seconds,
                                  1e6 * result.outcome.time);
    } else if (!result.outcome.completed()) {
      point.message =
          fmt::format("at {:.6g} us {}", 1e6 * result.outcome.time, result.outcome.message);
    } else if (point.errors.unmatched) {
      point.message = fmt::format("{} of {}; {}", counted(point.errors.n_found, "sub-impact"),
                                  point.errors.n_reference, point.errors.unmatched->description);
    }
  } catch (const InvalidCase& error) {
    point.verdict = Verdict::refused;
    point.message = error.key + " " + error.what();
  }
}

}  // namespace

OutcomeMap outcome_map(const Case& input, const std::vector<std::string>& methods,
                       double run_seconds, const Count& progress) {
  OutcomeMap map;
  map.reference = compute_reference(input, reference_error);
  std::vector<Trial> trials = all_trials(input, methods);
  std::mutex mutex;
  std::size_t done = 0;
  bool stopped = false;
  in_parallel(trials.size(), [&](std::size_t i) {
    {
      const std::lock_guard lock(mutex);
      if (stopped) {
        trials[i].point.verdict = Verdict::not_run;
        trials[i].point.message = "left out: interrupted";
        return;
      }
    }
    run(trials[i], map.reference, run_seconds);
    const std::lock_guard lock(mutex);
    if (progress && !progress(++done, trials.size())) stopped = true;
  });
  for (const Trial& trial : trials) map.points.push_back(trial.point);
  return map;
}

}  // namespace subimpact
