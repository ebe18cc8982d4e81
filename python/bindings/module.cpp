#include <exception>

#include "bindings.h"
#include "numerics/lanes.h"
#include "subimpact/io/results.h"

namespace subimpact::python {
namespace {

template <class... Arguments>
void raise(const char* name, const Arguments&... arguments) {
  const py::object type = py::module_::import("subimpact._errors").attr(name);
  PyErr_SetObject(type.ptr(), type(arguments...).ptr());
}

void translate(std::exception_ptr failure) {
  try {
    if (failure) std::rethrow_exception(failure);
  } catch (const InvalidCase& error) {
    raise("CaseError", error.message, error.key);
  } catch (const Error& error) {
    const bool is_case = error.kind == ErrorKind::case_file;
    const bool is_results = error.kind == ErrorKind::results;
    raise(is_case ? "CaseError" : is_results ? "ResultsError" : "OutputError", error.what());
  }
}

}  // namespace
}  // namespace subimpact::python

PYBIND11_MODULE(_core, module) {
  using namespace subimpact::python;
  if (!subimpact::is_processor_sufficient()) {
    throw py::import_error(subimpact::insufficient_processor);
  }
  module.doc() = "The library subimpact, as the package subimpact uses it.";
  py::register_exception_translator(&translate);
  module.attr("__version__") = subimpact::project_version();
  bind_cases(module);
  bind_results(module);
  bind_runs(module);
  bind_studies(module);
  bind_directories(module);
}
