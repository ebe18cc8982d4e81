#pragma once

/// The Python module subimpact._core: the library, one file per part. What users call is in
/// python/subimpact/.

#include <pybind11/pybind11.h>

#include <optional>
#include <vector>

#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"

namespace subimpact::python {

namespace py = pybind11;

void bind_cases(py::module_& module);
void bind_results(py::module_& module);
void bind_runs(py::module_& module);
void bind_studies(py::module_& module);
void bind_directories(py::module_& module);

/// The key of this name. Throws InvalidCase for a name that is none.
const CaseKey& key_of(const std::string& name);
/// A Python value as one of a key; NumPy's numbers and arrays are taken as Python's. Throws
/// InvalidCase, whose message begins with the key, for a value that the key does not allow.
KeyValue key_value(const CaseKey& key, py::handle value);
/// None: left open.
py::object to_python(const std::optional<KeyValue>& value);

/// What `body` returns; an InvalidCase gets the place of its key.
template <class Body>
auto with_places(const LoadedCase& loaded, Body body) {
  try {
    return body();
  } catch (const InvalidCase& error) {
    throw InvalidCase(error.key, loaded.message(error));
  }
}

}  // namespace subimpact::python
