#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "subimpact/case/simulate.h"

namespace subimpact {

/// Calls task(0) to task(n - 1), `jobs` at a time (0: as many as the machine has cores), in no
/// particular order. Not for anything that is timed. Rethrows the first exception, which stops all.
inline void in_parallel(std::size_t n, unsigned jobs,
                        const std::function<void(std::size_t)>& task) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < n; i = next++) {
      try {
        task(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = n;
      }
    }
  };
  std::vector<std::thread> threads;
  const std::size_t n_threads =
      std::min<std::size_t>(n, std::max(1u, jobs ? jobs : std::thread::hardware_concurrency()));
  for (std::size_t i = 1; i < n_threads; ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

/// Runs cases, `jobs` at a time. `progress` ends all; `finished`, one call at a time, counts those
/// that were not stopped.
inline std::vector<Result> simulate_all(const std::vector<Case>& cases, unsigned jobs,
                                        const Progress& progress = {},
                                        const std::function<void()>& finished = {}) {
  std::vector<Result> results(cases.size());
  std::mutex mutex;
  std::atomic<bool> stop = false;
  const auto goes_on = [&](double time) {
    if (progress && !progress(time)) stop = true;
    return !stop;
  };
  in_parallel(cases.size(), jobs, [&](std::size_t i) {
    results[i] = simulate(cases[i], goes_on);
    if (results[i].outcome.kind == OutcomeKind::stopped) return;
    const std::lock_guard lock(mutex);
    if (finished) finished();
  });
  return results;
}

}  // namespace subimpact
