#pragma once

#include <atomic>
#include <future>
#include <optional>

#include "subimpact/study/companion.h"

namespace subimpact {

/// A run and another one of which only the result matters.
struct RunPair {
  Result run;
  std::optional<Result> other;  ///< none where there is no other case, or the run was stopped
};

/// Runs a case and, if `other` is given, that one too: in a thread of its own with more than one
/// job. `progress` and `rows` are those of the first; a run that is stopped stops the other.
inline RunPair run_beside(const Case& input, const Case* other, Jobs jobs, const Progress& progress,
                          RowSink* rows) {
  std::atomic<bool> stop = false;
  const auto run_other = [&] { return simulate(*other, [&stop](double) { return !stop; }); };
  std::future<Result> beside;
  if (other && jobs > 1) beside = std::async(std::launch::async, run_other);
  RunPair pair{simulate(input, progress, nullptr, rows), std::nullopt};
  stop = pair.run.outcome.kind == OutcomeKind::stopped;
  if (other && !stop) pair.other = beside.valid() ? beside.get() : run_other();
  return pair;
}

}  // namespace subimpact
