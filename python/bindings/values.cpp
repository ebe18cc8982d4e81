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

// NumPy's bool is no number of Python, but converts to one.
bool is_bool(py::handle value) {
  return PyBool_Check(value.ptr()) || std::string(Py_TYPE(value.ptr())->tp_name) == "numpy.bool_";
}

bool is_number(py::handle value) {
  return !is_bool(value) && !py::isinstance<py::str>(value) && !PyComplex_Check(value.ptr()) &&
         PyNumber_Check(value.ptr()) != 0 && !py::hasattr(value, "__len__");
}

std::optional<KeyValue> number(py::handle value) {
  if (PyIndex_Check(value.ptr())) {
    const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    if (!whole) throw py::error_already_set();
    int overflow = 0;
    const long long fits = PyLong_AsLongLongAndOverflow(whole.ptr(), &overflow);
    if (overflow == 0) return std::int64_t{fits};
  }
  const double real = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    return std::nullopt;
  }
  return real;
}

std::optional<KeyValue> list(py::handle value) {
  std::vector<std::string> texts;
  std::vector<double> numbers;
  for (const py::handle item : py::iter(value)) {
    if (py::isinstance<py::str>(item)) {
      texts.push_back(item.cast<std::string>());
    } else if (is_number(item)) {
      numbers.push_back(PyFloat_AsDouble(item.ptr()));
      if (PyErr_Occurred() != nullptr) throw py::error_already_set();
    } else {
      return std::nullopt;
    }
  }
  if (texts.empty()) return numbers;
  if (!numbers.empty()) return std::nullopt;
  return texts;
}

std::optional<KeyValue> any_value(py::handle given) {
  const bool is_array = std::string(Py_TYPE(given.ptr())->tp_name) == "numpy.ndarray";
  const bool is_single = is_array && given.attr("ndim").cast<int>() == 0;
  const auto value = is_single ? py::object(given.attr("item")()) : given.cast<py::object>();
  if (is_bool(value)) return value.cast<py::object>().attr("__bool__")().cast<bool>();
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (is_number(value)) return number(value);
  const bool is_list = !py::isinstance<py::dict>(value) && !py::isinstance<py::bytes>(value) &&
                       py::hasattr(value, "__iter__") && py::hasattr(value, "__len__");
  return is_list ? list(value) : std::nullopt;
}

// A list of dicts, such as {"position": 0.5, "stiffness": "2 kN/m"}, with numbers of NumPy too.
std::optional<KeyValue> placed(const CaseKey& key, py::handle value) {
  try {
    const py::object to_list = py::module_::import("operator").attr("methodcaller")("tolist");
    const auto json =
        py::module_::import("json").attr("dumps")(value, py::arg("default") = to_list);
    const Json list = Json::parse(json.cast<std::string>());
    return list.is_array() ? key_value_of(key, list) : std::nullopt;
  } catch (const py::error_already_set&) {  // what JSON does not have
    return std::nullopt;
  } catch (const Json::exception&) {  // inf, nan
    return std::nullopt;
  }
}

}  // namespace

KeyValue key_value(const CaseKey& key, py::handle value) {
  const bool is_placed = key.type == KeyType::placed && !py::isinstance<py::str>(value);
  std::optional<KeyValue> converted = is_placed ? placed(key, value) : any_value(value);
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
  return std::visit(
      [](const auto& x) -> py::object {
        using Value = std::decay_t<decltype(x)>;
        if constexpr (std::is_same_v<Value, bool>) {
          return py::bool_(x);
        } else if constexpr (std::is_same_v<Value, std::int64_t>) {
          return py::int_(x);
        } else if constexpr (std::is_same_v<Value, double>) {
          return py::float_(x);
        } else if constexpr (std::is_same_v<Value, std::string>) {
          return py::str(x);
        } else if constexpr (std::is_same_v<Value, PlacedValues>) {
          return py::module_::import("json").attr("loads")(json_of(KeyValue(x)).dump());
        } else {
          py::list items;
          for (const auto& item : x) items.append(py::cast(item));
          return items;
        }
      },
      *value);
}

}  // namespace subimpact::python
