#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>

#include "bindings.h"
#include "finished.h"
#include "overseer.h"
#include "subimpact/report/text.h"
#include "subimpact/study/run_as_asked.h"

namespace subimpact::python {
namespace {

std::optional<ErrorBars> error_bars_named(const std::optional<std::string>& name) {
  if (!name) return std::nullopt;
  if (*name == "off") return ErrorBars::off;
  if (*name == "all") return ErrorBars::all;
  throw py::value_error("error_bars is \"" + *name +
                        "\"; allowed: None (from coarser meshes), \"off\", \"all\"");
}

Finished run(const LoadedCase& loaded, const std::optional<std::string>& error_bars, Jobs jobs,
             const py::object& progress, const std::optional<double>& timeout, bool body_errors) {
  Overseer overseer(progress, timeout);
  RunRequest request;
  request.error_bars = error_bars_named(error_bars);
  request.jobs = jobs;
  request.body_errors = body_errors;
  request.progress = [&overseer](double time) { return overseer.goes_on(time); };
  WithinRun made = [&] {
    const py::gil_scoped_release released;
    return with_places(loaded, [&] {
      WithinRun run = run_as_asked(loaded.value, loaded.given, std::move(request));
      make_answers(run.input, run.result);
      return run;
    });
  }();
  overseer.finish();
  return {std::move(made.input), std::move(made.result), overseer.interrupted(),
          overseer.timed_out()};
}

}  // namespace

void bind_runs(py::module_& module) {
  module.def("run", &run, py::arg("case"), py::arg("error_bars"), py::arg("jobs"),
             py::arg("progress"), py::arg("timeout"), py::arg("body_errors"));
}

}  // namespace subimpact::python
