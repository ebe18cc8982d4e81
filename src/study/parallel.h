#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace subimpact {

/// Calls task(0) to task(n - 1), `jobs` at a time (0: as many as the machine has cores), in no
/// particular order. Not for anything that is timed. Rethrows the first exception, which stops all.
inline void in_parallel(std::size_t n, const std::function<void(std::size_t)>& task,
                        unsigned jobs = 0) {
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

}  // namespace subimpact
