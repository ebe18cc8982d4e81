#include <fmt/format.h>

#include <cmath>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "bindings.h"
#include "case/keys/units.h"
#include "io/records/record.h"

namespace subimpact::python {
namespace {

// By way of JSON, with numbers of NumPy and others; nothing for what JSON does not have.
std::optional<KeyValue> any_value(const CaseKey& key, py::object value) {
  const auto plain = [](const py::object& x) -> py::object {
    return py::hasattr(x, "tolist") ? x.attr("tolist")() : py::object(py::float_(x));
  };
  if (py::hasattr(value, "tolist")) value = plain(value);
  if (PyFloat_Check(value.ptr())) return value.cast<double>();  // perhaps infinite
  try {
    const auto json = py::module_::import("json").attr("dumps")(
        value, py::arg("default") = py::cpp_function(plain));
    return key_value_of(key, Json::parse(json.cast<std::string>()));
  } catch (const std::exception&) {  // of Python, of JSON, of a number that does not fit
    return std::nullopt;
  }
}

}  // namespace

KeyValue key_value(const CaseKey& key, py::handle value) {
  std::optional<KeyValue> converted = any_value(key, value.cast<py::object>());
  const auto* real = converted ? std::get_if<double>(&*converted) : nullptr;
  const bool is_whole = real != nullptr && std::abs(*real) < 1e15 && std::trunc(*real) == *real;
  if (key.type == KeyType::count && is_whole) converted = static_cast<std::int64_t>(*real);
  const auto* text = converted ? std::get_if<std::string>(&*converted) : nullptr;
  const bool is_with_unit = text != nullptr && key.type == KeyType::number;
  const std::string unit = is_position(key) ? "m" : key.unit;
  if (const auto in_si = is_with_unit ? value_in(unit, *text) : std::nullopt) {
    const auto problem = problem_with(key, *in_si);
    if (problem && !is_position(key)) {
      throw InvalidCase(key.name, key.name + ' ' + *problem);
    }
    return *converted;  // the unit is checked against the law when the case is read
  }
  const auto problem = converted ? problem_with(key, *converted)
                                 : std::optional(refusal(key, py::repr(value).cast<std::string>()));
  if (problem) throw InvalidCase(key.name, key.name + ' ' + *problem);
  return *converted;
}

py::object to_python(const std::optional<KeyValue>& value) {
  if (!value) return py::none();
  if (const auto* number = std::get_if<double>(&*value)) return py::float_(*number);
  return py::module_::import("json").attr("loads")(
      json_of(*value).dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace subimpact::python
