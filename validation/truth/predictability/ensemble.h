#pragma once

/// Many runs of a case whose numbers scatter, which show what standard deviations by first
/// derivatives are worth.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "subimpact/study/population.h"
#include "subimpact/study/sensitivity/predictability.h"

namespace subimpact::predictability {

struct EnsembleOptions {
  std::size_t n_runs = 2000;
  std::uint64_t seed = 1;
  double rtol = 1e-9;  ///< at which runs differ by far less than they scatter
  Jobs jobs = 1;
  /// Called after each run that ended, with the number so far.
  std::function<void(std::size_t n_done)> finished;
  Progress progress;
};

/// What the runs of an ensemble make of one sub-impact of the base run.
struct EnsembleEvent {
  std::size_t n_present = 0;  ///< runs that have it as it is in the base run
  /// Runs in which contacts have merged, split, vanished or appeared before it, or it did itself.
  std::size_t n_changed_so_far = 0;
  std::size_t n_changed = 0;                       ///< the same, in it or just before it
  double start_mean = 0.0, start_deviation = 0.0;  ///< s, over the runs that have it
  double end_mean = 0.0, end_deviation = 0.0;      ///< s
};

struct Ensemble {
  std::vector<EnsembleEvent> events;  ///< by sub-impact of the base run
  std::vector<Result> runs;           ///< that completed: sub-impacts only
  std::size_t n_failed = 0;
  bool interrupted = false;
};

/// The samples of a Population. The sub-impacts of a run are matched with those of the base run
/// after these are moved by what the derivatives of the study foresee.
Ensemble ensemble(const Sensitivity& study, const Scatter& scatter,
                  const EnsembleOptions& options = {});

}  // namespace subimpact::predictability
