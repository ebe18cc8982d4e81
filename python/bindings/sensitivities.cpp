#include <pybind11/stl.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "finished.h"
#include "overseer.h"
#include "report/study_columns.h"
#include "subimpact/io/output_directory.h"
#include "subimpact/io/results.h"
#include "subimpact/report/studies.h"
#include "subimpact/report/text.h"
#include "subimpact/study/run_as_asked.h"
#include "subimpact/study/sensitivity/predictability.h"
#include "tables.h"

namespace subimpact::python {
namespace {

Sensitivity study_of(const LoadedCase& loaded, const std::vector<std::string>& keys, Jobs jobs,
                     const py::object& progress) {
  for (const std::string& name : keys) key_of(name);
  Overseer overseer(progress, std::nullopt);
  const auto goes_on = [&overseer](double) { return overseer.goes_on(); };
  Sensitivity study = [&] {
    const py::gil_scoped_release released;
    return with_places(loaded, [&] {
      SensitivityOptions options;
      options.keys = keys;
      options.jobs = jobs;
      options.progress = goes_on;
      options.finished = [&overseer](std::size_t n_done, std::size_t n_all) {
        overseer.count(n_done, n_all);
      };
      return sensitivity(case_as_chosen(loaded.value, loaded.given, jobs, goes_on), options);
    });
  }();
  overseer.finish();
  if (study.interrupted && study.keys.empty() && overseer.interrupted()) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
  return study;
}

// The base run, with what the scatter of its case leaves of it if the study has all its keys.
Finished base_run(const Sensitivity& study) {
  Finished run{study.input, study.base};
  const std::vector<std::string> keys = scattering_keys(study.input);
  const bool has_all = std::ranges::all_of(keys, [&](const std::string& key) {
    return std::ranges::find(study.keys, key) != study.keys.end();
  });
  if (!study.rows.empty() && !keys.empty() && has_all) {
    set_predictability(run.result, study, study.input.scatter);
  }
  make_answers(run.input, run.result);
  return run;
}

void write(const Sensitivity& study, const std::string& path) {
  OutputDirectory directory(path, "sensitivity");
  write_sensitivity(directory.staging(), study);
  directory.commit();
}

}  // namespace

void bind_sensitivities(py::module_& module) {
  module.def("sensitivity", &study_of, py::arg("case"), py::arg("keys"), py::arg("jobs"),
             py::arg("progress"));
  py::class_<Sensitivity>(module, "Study")
      .def("table",
           [](const Sensitivity& study) {
             return table(sensitivity_columns(study.keys), study.rows);
           })
      .def("base", &base_run)
      .def("report", &sensitivity_table)
      .def("write", &write, py::arg("directory"), py::call_guard<py::gil_scoped_release>())
      .def_readonly("keys", &Sensitivity::keys)
      .def_readonly("remarks", &Sensitivity::remarks)
      .def_readonly("interrupted", &Sensitivity::interrupted);
}

}  // namespace subimpact::python
