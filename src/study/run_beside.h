#pragma once

#include <atomic>
#include <future>
#include <new>
#include <optional>
#include <system_error>

#include "subimpact/study/companion.h"

namespace subimpact {

/// A run and another one of which only the result matters.
struct RunPair {
  Result run;
  std::optional<Result> other;  ///< none where there is no other case, or the run was stopped
};

/// Runs a case and, if `other` is given, that one too: in a thread of its own with more than one
/// job, or afterwards where memory or system have no room for that. `progress` and `rows` are those
/// of the first; a run that is stopped stops the other. Without memory for the other the first has
/// a warning.
inline RunPair run_beside(const Case& input, const Case* other, Jobs jobs, const Progress& progress,
                          RowSink* rows) {
  std::atomic<bool> stop = false;
  const auto run_other = [&] { return simulate(*other, [&stop](double) { return !stop; }); };
  std::future<Result> beside;
  try {
    if (other && jobs > 1) beside = std::async(std::launch::async, run_other);
  } catch (const std::system_error&) {  // no thread
  }
  RunPair pair{simulate(input, progress, nullptr, rows), std::nullopt};
  stop = pair.run.outcome.kind == OutcomeKind::stopped;
  if (!other || stop) return pair;
  try {
    if (beside.valid()) pair.other = beside.get();
  } catch (const std::bad_alloc&) {
  }
  try {
    if (!pair.other) pair.other = run_other();
  } catch (const std::bad_alloc&) {
    pair.run.warnings.push_back(
        "the memory does not suffice for the run to compare with: errors are not known");
  }
  return pair;
}

}  // namespace subimpact
