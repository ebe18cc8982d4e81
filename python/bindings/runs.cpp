#include <pybind11/stl.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "bindings.h"
#include "finished.h"
#include "subimpact/study/run_as_asked.h"

namespace subimpact::python {
namespace {

using Clock = std::chrono::steady_clock;

std::optional<ErrorBars> error_bars_named(const std::optional<std::string>& name) {
  if (!name) return std::nullopt;
  if (*name == "off") return ErrorBars::off;
  if (*name == "time") return ErrorBars::time;
  if (*name == "all") return ErrorBars::all;
  throw py::value_error("error_bars is \"" + *name +
                        "\"; allowed: None (from a companion), \"off\", \"time\", \"all\"");
}

/// Looks at Python from within a run, twenty times per second: for Ctrl-C, for a callback, and for
/// the time that the run has taken. Created and destroyed with the GIL.
class Overseer {
 public:
  Overseer(py::object callback, std::optional<double> timeout) : callback_(std::move(callback)) {
    if (timeout) {
      deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double>(*timeout));
    }
  }

  /// Called without the GIL. False: the run is to end.
  bool go_on(double time) {
    if (is_ended()) return false;
    const Clock::time_point now = Clock::now();
    timed_out_ = deadline_ && now > *deadline_;
    if (timed_out_) return false;
    if (now < next_look_) return true;
    next_look_ = now + pause;
    const py::gil_scoped_acquire gil;
    look(time);
    return !is_ended();
  }

  bool interrupted() const { return interrupted_; }
  bool timed_out() const { return timed_out_; }
  /// Rethrows what the callback threw.
  void rethrow() {
    if (failure_) throw py::error_already_set(*failure_);
  }

 private:
  static constexpr std::chrono::milliseconds pause{50};

  bool is_ended() const { return interrupted_ || timed_out_ || stopped_ || failure_; }

  void look(double time) {
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (callback_.is_none()) return;
      const py::object answer = callback_(time);
      stopped_ = !answer.is_none() && !py::bool_(answer);
    } catch (py::error_already_set& error) {
      if (error.matches(PyExc_KeyboardInterrupt)) {
        interrupted_ = true;
      } else {
        failure_ = error;
      }
    }
  }

  py::object callback_;
  std::optional<Clock::time_point> deadline_;
  Clock::time_point next_look_{};
  bool interrupted_ = false, timed_out_ = false, stopped_ = false;
  std::optional<py::error_already_set> failure_;
};

Finished run(const LoadedCase& loaded, const std::optional<std::string>& error_bars, Jobs jobs,
             const py::object& progress, const std::optional<double>& timeout) {
  Overseer overseer(progress, timeout);
  RunRequest request;
  request.error_bars = error_bars_named(error_bars);
  request.jobs = jobs;
  request.progress = [&overseer](double time) { return overseer.go_on(time); };
  WithinRun made = [&] {
    const py::gil_scoped_release released;
    return with_places(
        loaded, [&] { return run_as_asked(loaded.value, loaded.given, std::move(request)); });
  }();
  overseer.rethrow();
  return {std::move(made.input), std::move(made.result), overseer.interrupted(),
          overseer.timed_out()};
}

}  // namespace

void bind_runs(py::module_& module) {
  module.def("run", &run, py::arg("case"), py::arg("error_bars"), py::arg("jobs"),
             py::arg("progress"), py::arg("timeout"));
}

}  // namespace subimpact::python
