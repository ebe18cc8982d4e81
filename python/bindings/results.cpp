#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>

#include "bindings.h"
#include "finished.h"
#include "io/run_tables.h"
#include "subimpact/io/read_results.h"
#include "subimpact/io/report.h"
#include "subimpact/io/results.h"
#include "tables.h"

namespace subimpact::python {
namespace {

py::array table_named(const Finished& run, const std::string& name) {
  const Result& result = run.result;
  if (name == "sub_impacts") return table(events_columns(result), result.sub_impacts);
  if (name == "transitions") return table(transitions_columns(), result.transitions);
  if (name == "history") return table(history_columns(), result.history);
  if (name == "sections") return table(sections_columns(), result.section_history);
  if (name == "points") return table(points_columns(), result.point_history);
  if (name == "shapes") return table(shapes_columns(), result.shapes);
  if (name == "envelope") return table(envelope_columns(), result.envelope);
  throw py::key_error(name);
}

Finished read(const std::string& directory) {
  FinishedRun run = read_results(directory);
  return {std::move(run.input), std::move(run.result)};
}

py::object first_failure(const Finished& run) {
  const auto& failure = run.result.outcome.first_failure;
  return failure ? py::object(py::make_tuple(failure->from, failure->to)) : py::none();
}

double total_impulse(const Finished& run) {
  double sum = 0.0;
  for (const SubImpact& s : run.result.sub_impacts) sum += s.impulse;
  return sum;
}

double residual_indentation(const Finished& run) {
  const auto& all = run.result.sub_impacts;
  return all.empty() ? 0.0 : all.back().residual_indentation;
}

std::optional<std::size_t> n_predictable(const Finished& run) {
  const Result& result = run.result;
  if (!result.predictability) return std::nullopt;
  return result.predictability->first_unpredictable.value_or(result.sub_impacts.size());
}

}  // namespace

void bind_results(py::module_& module) {
  const auto member = [](auto pointer) {
    return [pointer](const Finished& run) { return run.result.*pointer; };
  };
  module.def("read_results", &read, py::arg("directory"), py::call_guard<py::gil_scoped_release>());
  module.def("columns", &column_listing);
  py::class_<Finished>(module, "Finished")
      .def("table", &table_named, py::arg("name"))
      .def(
          "write",
          [](const Finished& run, const std::string& directory) {
            write_results(directory, run.input, run.result);
          },
          py::arg("directory"), py::call_guard<py::gil_scoped_release>())
      .def("summary", [](const Finished& run) { return summary_json(run.input, run.result); })
      .def("events_csv", [](const Finished& run) { return events_csv(run.result); })
      .def("report",
           [](const Finished& run) {
             const bool has_scatter = run.result.predictability.has_value();
             return run_summary(run.input, run.result) + '\n' + sub_impact_table(run.result) +
                    (has_scatter ? '\n' + scatter_table(run.result) : std::string());
           })
      .def("brief", [](const Finished& run) { return run.result.brief_report(); })
      .def(
          "value",
          [](const Finished& run, const std::string& name) {
            const CaseKey* key = find_case_key(name);
            if (key == nullptr) throw py::key_error(name);
            return to_python(key->get(run.input));
          },
          py::arg("key"))
      .def_property_readonly(
          "outcome",
          [](const Finished& run) { return std::string(to_string(run.result.outcome.kind)); })
      .def_property_readonly("time", [](const Finished& run) { return run.result.outcome.time; })
      .def_property_readonly("message",
                             [](const Finished& run) { return run.result.outcome.message; })
      .def_property_readonly("first_failure", &first_failure)
      .def_property_readonly("usable", [](const Finished& run) { return run.result.is_usable(); })
      .def_property_readonly("warnings", member(&Result::warnings))
      .def_property_readonly("n_sub_impacts",
                             [](const Finished& run) { return run.result.sub_impacts.size(); })
      .def_property_readonly(
          "n_zones",
          [](const Finished& run) { return summarise_zones(run.result.sub_impacts).size(); })
      .def_property_readonly("n_decided",
                             [](const Finished& run) { return run.result.n_decided(); })
      .def_property_readonly("all_decided",
                             [](const Finished& run) { return run.result.all_decided(); })
      .def_property_readonly("wish_met",
                             [](const Finished& run) {
                               return run.result.wish ? std::optional(run.result.wish->met)
                                                      : std::nullopt;
                             })
      .def_property_readonly("horizon",
                             [](const Finished& run) {
                               return run.result.wish ? std::optional(run.result.wish->horizon)
                                                      : std::nullopt;
                             })
      .def_property_readonly("predictable_until",
                             [](const Finished& run) {
                               const auto& found = run.result.predictability;
                               return found ? std::optional(found->horizon) : std::nullopt;
                             })
      .def_property_readonly("n_predictable", &n_predictable)
      .def_property_readonly("first_section_yield", member(&Result::first_section_yield))
      .def_property_readonly("first_contact_yield", member(&Result::first_contact_yield))
      .def_property_readonly("max_force", member(&Result::max_force))
      .def_property_readonly("max_indentation", member(&Result::max_indentation))
      .def_property_readonly("residual_indentation", &residual_indentation)
      .def_property_readonly("impulse", &total_impulse)
      .def_property_readonly("striker_velocity", member(&Result::striker_velocity))
      .def_property_readonly("beam_mean_velocity", member(&Result::beam_mean_velocity))
      .def_property_readonly("max_energy_error", member(&Result::max_energy_error))
      .def_readonly("interrupted", &Finished::interrupted)
      .def_readonly("timed_out", &Finished::timed_out);
}

}  // namespace subimpact::python
