#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "subimpact/case/simulate.h"

namespace subimpact {

/// Calls task(0) to task(n - 1), `jobs` at a time (0: as many as the machine has cores; fewer if it
/// refuses threads), in no particular order. Not for anything that is timed. `progress` is called
/// with the numbers of tasks that ended and of all, one call at a time; false: no more tasks begin.
/// Rethrows the first exception, which stops all.
inline void in_parallel(std::size_t n, unsigned jobs, const std::function<void(std::size_t)>& task,
                        const std::function<bool(std::size_t, std::size_t)>& progress = {}) {
  std::atomic<std::size_t> next{0};
  std::size_t done = 0;
  std::exception_ptr failure;
  std::mutex mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < n; i = next++) {
      try {
        task(i);
        const std::lock_guard lock(mutex);
        if (progress && !progress(++done, n)) next = n;
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = n;
      }
    }
  };
  std::vector<std::jthread> threads;
  const std::size_t n_threads =
      std::min<std::size_t>(n, std::max(1u, jobs ? jobs : std::thread::hardware_concurrency()));
  try {
    for (std::size_t i = 1; i < n_threads; ++i) threads.emplace_back(work);
  } catch (const std::system_error&) {  // no memory for its stack, or too many of them
  }
  work();
  for (std::jthread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace subimpact
