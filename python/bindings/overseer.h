#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <optional>
#include <utility>

#include "bindings.h"

namespace subimpact::python {

/// Looks at Python from within runs, twenty times per second: for Ctrl-C, for a callback, and for
/// the time that has passed. Created, finished and destroyed with the GIL; its other functions are
/// called without the GIL, from any thread.
class Overseer {
 public:
  /// `callback`: None, or a function whose return value False ends the runs.
  Overseer(py::object callback, const std::optional<double>& timeout)
      : callback_(std::move(callback)) {
    if (timeout) {
      deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double>(*timeout));
    }
  }

  /// False: the runs are to end. Calls the callback with the simulated time, if there is one.
  bool goes_on(const std::optional<double>& time = {}) {
    const std::lock_guard lock(mutex_);
    if (is_ended() || !is_time_to_look()) return !is_ended();
    const py::gil_scoped_acquire gil;
    look_for_signals();
    if (time) call(*time);
    return !is_ended();
  }

  /// Calls the callback with the number of runs that ended.
  void count(std::size_t n_done, std::size_t n_all) {
    const std::lock_guard lock(mutex_);
    if (is_ended()) return;
    const py::gil_scoped_acquire gil;
    call(n_done, n_all);
  }

  /// After the runs: looks once more, and rethrows what the callback threw.
  void finish() {
    look_for_signals();
    if (failure_) throw py::error_already_set(*failure_);
  }

  bool interrupted() const { return interrupted_; }
  bool timed_out() const { return timed_out_; }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds pause{50};

  bool is_ended() const { return interrupted_ || timed_out_ || stopped_ || failure_; }

  bool is_time_to_look() {
    const Clock::time_point now = Clock::now();
    timed_out_ = deadline_ && now > *deadline_;
    if (timed_out_ || now < next_look_) return false;
    next_look_ = now + pause;
    return true;
  }

  void look_for_signals() {
    if (PyErr_CheckSignals() != 0) keep(py::error_already_set());
  }

  template <class... Arguments>
  void call(Arguments... arguments) {
    if (callback_.is_none() || is_ended()) return;
    try {
      const py::object answer = callback_(arguments...);
      stopped_ = !answer.is_none() && !py::bool_(answer);
    } catch (const py::error_already_set& error) {
      keep(error);
    }
  }

  void keep(const py::error_already_set& error) {
    if (error.matches(PyExc_KeyboardInterrupt)) {
      interrupted_ = true;
    } else {
      failure_ = error;
    }
  }

  py::object callback_;
  std::optional<Clock::time_point> deadline_;
  std::mutex mutex_;
  Clock::time_point next_look_{};
  bool interrupted_ = false, timed_out_ = false, stopped_ = false;
  std::optional<py::error_already_set> failure_;
};

}  // namespace subimpact::python
