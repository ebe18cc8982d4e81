#include <pybind11/stl.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "case/keys/units.h"
#include "subimpact/study/population.h"

namespace subimpact::python {
namespace {

// A stiffness has the unit of its law, which a sweep may change: its unit is refused.
KeyValue in_si(const CaseKey& key, KeyValue value) {
  const bool depends_on_law = key.unit.find(" or ") != std::string::npos;
  return depends_on_law ? value : in_unit_of(key, std::move(value));
}

// The points of one axis, with values as their keys take them.
PopulationAxis axis_of(const std::vector<std::string>& keys, const py::list& points) {
  PopulationAxis axis{keys, {}};
  for (const py::handle point : points) {
    const auto values = point.cast<std::vector<py::object>>();
    std::vector<KeyValue> converted;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const CaseKey* key = k < keys.size() ? find_case_key(keys[k]) : nullptr;
      converted.push_back(key != nullptr ? in_si(*key, key_value(*key, values[k])) : KeyValue());
    }
    axis.points.push_back(std::move(converted));
  }
  return axis;
}

using Axes = std::vector<std::pair<std::vector<std::string>, py::list>>;
using Scatter = std::map<std::string, double>;

Population make(const Axes& axes, const Scatter& scatter, std::size_t n_samples,
                std::uint64_t seed) {
  Population population;
  for (const auto& [keys, points] : axes) population.axes.push_back(axis_of(keys, points));
  population.scatter = scatter;
  population.n_samples = n_samples;
  population.seed = seed;
  return population;
}

std::vector<std::pair<std::string, py::object>> settings(const Population& population,
                                                         const LoadedCase& base,
                                                         std::size_t number) {
  if (number >= population.size()) throw py::index_error("number of a case");
  std::vector<std::pair<std::string, py::object>> values;
  for (const auto& [name, value] : population.settings(base.value, number)) {
    values.emplace_back(name, to_python(value));
  }
  return values;
}

}  // namespace

void bind_populations(py::module_& module) {
  py::class_<Population>(module, "Population")
      .def(py::init(&make), py::arg("axes"), py::arg("scatter"), py::arg("n_samples"),
           py::arg("seed"))
      .def("__len__", &Population::size)
      .def("keys", &Population::keys)
      .def(
          "check",
          [](const Population& population, const LoadedCase& base) {
            try {
              check(population, base.value);
            } catch (const InvalidCase& error) {
              throw InvalidCase(error.key, error.key + ' ' + error.what());
            }
          },
          py::arg("base"))
      .def(
          "scatter_of",
          [](const Population& population, const LoadedCase& base) {
            return scatter_of(base.value, population.axes);
          },
          py::arg("base"))
      .def("settings", &settings, py::arg("base"), py::arg("number"));
}

}  // namespace subimpact::python
