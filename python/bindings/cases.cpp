#include <fmt/format.h>
#include <pybind11/stl.h>

#include <string>
#include <tuple>

#include "bindings.h"
#include "case/keys/materials.h"
#include "case/keys/units.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/case/simulate.h"
#include "subimpact/io/results.h"
#include "subimpact/report/text.h"
#include "subimpact/study/model.h"
#include "subimpact/study/run_as_asked.h"

namespace subimpact::python {

const CaseKey& key_of(const std::string& name) {
  if (const CaseKey* key = find_case_key(name)) return *key;
  std::vector<std::string> names;
  for (const CaseKey& key : case_keys()) names.push_back(key.name);
  const std::string near = nearest_name(name, names);
  throw InvalidCase(name, fmt::format("unknown key \"{}\"; {}", name,
                                      near.empty() ? "subimpact.keys() lists those there are"
                                                   : fmt::format("did you mean \"{}\"?", near)));
}

namespace {

// In the order of KeyType.
constexpr const char* type_names[] = {"text",   "number", "count",   "flag",
                                      "choice", "pair",   "numbers", "placed"};

py::dict key_as_dict(const CaseKey& key) {
  py::list choices;
  for (const Choice& choice : key.choices) choices.append(choice.name);
  py::dict dict;
  dict["name"] = key.name;
  dict["type"] = type_names[static_cast<std::size_t>(key.type)];
  dict["unit"] = key.unit;
  dict["allowed"] = allowed_values(key);
  dict["least"] = key.limits.minimum ? key.limits.minimum : key.limits.exclusive_minimum;
  dict["most"] = key.limits.maximum;
  dict["choices"] = py::tuple(choices);
  dict["required"] = key.required;
  dict["default"] = key.default_text;
  dict["meaning"] = key.meaning;
  return dict;
}

using Setting = std::tuple<std::string, std::string, std::string>;

LoadedCase load(const std::string& text, const std::string& name,
                const std::vector<Setting>& settings) {
  std::vector<Override> overrides;
  for (const auto& [key, value, origin] : settings) overrides.push_back({key, value, origin});
  return read_case_text(text, name, overrides, choose_scene);
}

std::string explain(const LoadedCase& loaded) {
  return with_places(loaded, [&] { return explanation(loaded.value, loaded.given); });
}

// The summary of a run that has not begun: settings given and used.
std::string resolved_summary(const LoadedCase& loaded) {
  return with_places(loaded, [&] {
    const Case input = first_run(loaded.value, loaded.given).input;
    Result result;
    result.given = input;
    result.used = resolve(input).settings();
    return summary_json(input, result);
  });
}

}  // namespace

void bind_cases(py::module_& module) {
  module.def("materials", [] {
    py::list list;
    for (const Material& m : materials) {
      list.append(
          py::make_tuple(m.name, m.density, m.youngs_modulus, m.poisson, m.yield_stress, m.source));
    }
    return list;
  });
  module.def("keys", [] {
    py::list all;
    for (const CaseKey& key : case_keys()) all.append(key_as_dict(key));
    return all;
  });
  module.def(
      "checked",
      [](const std::string& name, const py::object& value) {
        return to_python(key_value(key_of(name), value));
      },
      py::arg("key"), py::arg("value"));
  module.def(
      "value_in",
      [](const std::string& unit, const std::string& text) { return value_in(unit, text); },
      py::arg("unit"), py::arg("text"));
  module.def("load", &load, py::arg("text"), py::arg("name"), py::arg("settings"));

  py::class_<LoadedCase>(module, "LoadedCase")
      .def(
          "value",
          [](const LoadedCase& loaded, const std::string& name) {
            return to_python(key_of(name).get(loaded.value));
          },
          py::arg("key"))
      .def("given",
           [](const LoadedCase& loaded) {
             std::vector<std::string> names;
             for (const CaseKey& key : case_keys()) {
               const bool is_given = loaded.given.contain(key.name);
               if (is_given) names.push_back(key.name);
             }
             return names;
           })
      .def("chosen", [](const LoadedCase& loaded) { return loaded.chosen; })
      .def("why_chosen", [](const LoadedCase& loaded) { return loaded.value.model_choice; })
      .def("notes", &LoadedCase::notes)
      .def("doubts", [](const LoadedCase& loaded) { return doubtful_units(loaded.value); })
      .def("explain", &explain)
      .def("resolved_summary", &resolved_summary)
      .def(
          "identity",
          [](const LoadedCase& loaded, const std::string& how) {
            return case_identity(loaded.value, loaded.given, how);
          },
          py::arg("how"));
}

}  // namespace subimpact::python
