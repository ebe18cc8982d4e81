#include <fmt/ranges.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "bindings.h"
#include "finished.h"
#include "io/records/run_tables.h"
#include "study/judgement/totals.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"
#include "subimpact/io/results.h"
#include "subimpact/report/text.h"
#include "subimpact/study/answers.h"
#include "tables.h"

namespace subimpact::python {
namespace {

// "sub_impacts" for events.csv; else the name of the file without its ending.
py::array table_named(const Finished& run, const std::string& name) {
  const std::string file = (name == "sub_impacts" ? "events" : name) + ".csv";
  py::object found = py::none();
  for_each_run_table([&](const auto& of_run) {
    if (file != of_run.file) return;
    found = table(of_run.columns_of(run.input.output), run.result.*of_run.rows);
  });
  if (found.is_none()) throw py::key_error(name);
  return found;
}

// --- tables of sweeps ----------------------------------------------------------------------------

auto member(auto pointer) {
  return [pointer](const Finished& run) { return run.result.*pointer; };
}

// The value of a function of an optional part of the result; none without that part.
template <class Part, class Value>
auto of_part(std::optional<Part> Assessment::*part, Value value) {
  return [=](const Finished& run) {
    const std::optional<Part>& there = run.result.*part;
    return there ? std::optional(std::invoke(value, *there)) : std::nullopt;
  };
}

// The same of the first sub-impact.
auto of_first(auto value) {
  return [=](const Finished& run) {
    const auto& all = run.result.sub_impacts;
    return all.empty() ? std::optional<double>() : all.front().*value;
  };
}

std::optional<int> all_certain(const Finished& run) {
  if (!run.result.error_estimate) return std::nullopt;
  return run.result.all_certain() ? 1 : 0;
}

std::optional<double> time_of_max_force(const Finished& run) {
  const auto& all = run.result.sub_impacts;
  const auto strongest = std::ranges::max_element(all, {}, &SubImpact::peak_force);
  return strongest == all.end() ? std::nullopt : std::optional(strongest->peak_time);
}

// Of an energy at the end.
auto at_end(double Energies::*energy) {
  return [energy](const Finished& run) { return run.result.final_energies.*energy; };
}

// The largest deflection at rest from the supports; none of a run without shapes, or that turns too
// far.
std::optional<double> permanent_set(const Finished& run) {
  const bool is_known = !run.result.envelope.empty() && !run.result.turns_too_far();
  if (!is_known) return std::nullopt;
  return largest_magnitude(run.result.envelope, &EnvelopeRow::set_from_supports);
}

double residual_indentation(const Finished& run) {
  const auto& all = run.result.sub_impacts;
  return all.empty() ? 0.0 : all.back().residual_indentation;
}

double striker_energy_share(const Finished& run) {
  return std::pow(run.result.striker_velocity / run.input.scene.bodies().velocity_scale(), 2);
}

auto error_of(RunTotal name) {
  return [name](const Finished& run) { return error_of_total(run.result, name); };
}

// What the warnings are about, in a word each, the same for all that have no word of their own.
std::string warnings_by_kind(const Finished& run) {
  std::vector<std::string_view> kinds;
  const std::size_t n_units = doubtful_units(run.input).size();
  if (n_units > 0) kinds.push_back("units");
  const auto beyond = beyond_the_model(run.input, run.result);
  for (const auto& [kind, sentence] : beyond) kinds.push_back(kind);
  if (run.result.warnings.size() > n_units + beyond.size()) kinds.push_back("computation");
  return fmt::format("{}", fmt::join(kinds, ";"));
}

// The columns that runs.csv has of a run.
const Columns<Finished>& swept_run_columns() {
  static const Columns<Finished> columns = {
      {"outcome", [](const Finished& run) { return run.result.outcome.kind; }},
      {"time_s", [](const Finished& run) { return run.result.outcome.time; }},
      {"n_sub_impacts", [](const Finished& run) { return run.result.sub_impacts.size(); }},
      {"n_zones",
       [](const Finished& run) { return summarise_zones(run.result.sub_impacts).size(); }},
      {"n_certain", [](const Finished& run) { return run.result.n_certain(); }},
      {"all_certain", &all_certain},
      {"wish_met",
       of_part(&Result::tolerance, [](const ToleranceOutcome& w) { return w.met ? 1 : 0; })},
      {"horizon_s", of_part(&Result::tolerance, &ToleranceOutcome::horizon)},
      {"first_separation_s", of_first(&SubImpact::end)},
      {"first_separation_error_s", of_first(&SubImpact::end_error)},
      {"first_section_yield_s", member(&Result::first_section_yield)},
      {"first_contact_yield_s", member(&Result::first_contact_yield)},
      {"max_force_N", member(&Result::max_force)},
      {"max_force_error_N", error_of(RunTotal::peak_force)},
      {"max_force_time_s", &time_of_max_force},
      {"max_indentation_m", member(&Result::max_indentation)},
      {"max_indentation_error_m", error_of(RunTotal::max_indentation)},
      {"residual_indentation_m", &residual_indentation},
      {"residual_indentation_error_m", error_of(RunTotal::residual_indentation)},
      {"permanent_set_m", &permanent_set},
      {"permanent_set_error_m", error_of(RunTotal::permanent_set)},
      {"impulse_Ns", [](const Finished& run) { return run.result.impulse(); }},
      {"impulse_error_Ns", error_of(RunTotal::impulse)},
      {"striker_velocity_m_per_s", member(&Result::striker_velocity)},
      {"striker_velocity_error_m_per_s", error_of(RunTotal::striker_velocity)},
      {"beam_mean_velocity_m_per_s", member(&Result::beam_mean_velocity)},
      {"beam_mean_velocity_error_m_per_s", error_of(RunTotal::beam_mean_velocity)},
      {"restitution", member(&Result::restitution)},
      {"restitution_error", error_of(RunTotal::restitution)},
      {"striker_energy_share", &striker_energy_share},
      {"striker_energy_share_error", error_of(RunTotal::striker_energy_share)},
      {"bending_plastic_J", at_end(&Energies::bending_plastic)},
      {"contact_plastic_J", at_end(&Energies::contact_plastic)},
      {"beam_damping_J", at_end(&Energies::beam_damping)},
      {"contact_over", [](const Finished& run) { return run.result.contact_over ? 1 : 0; }},
      {"max_energy_error", member(&Result::max_energy_error)},
      {"warnings", &warnings_by_kind}};
  return columns;
}

std::vector<std::string> names_of_columns(const auto& columns) {
  std::vector<std::string> names;
  for (const auto& column : columns) names.push_back(column.name);
  return names;
}

}  // namespace

void bind_results(py::module_& module) {
  module.def(
      "no_rows", [](const std::string& table) { return table_named({}, table); }, py::arg("table"));
  module.def("columns", &column_listing);
  module.def("event_columns", [] { return names_of_columns(run_table<SubImpact>().columns); });
  module.def("swept_columns", [] { return names_of_columns(swept_run_columns()); });
  py::class_<Finished>(module, "Finished")
      .def("table", &table_named, py::arg("name"))
      .def(
          "write",
          [](const Finished& run, const std::string& directory) {
            write_results(directory, run.input, run.result, report_json(run.input, run.result));
          },
          py::arg("directory"), py::call_guard<py::gil_scoped_release>())
      .def("summary", [](const Finished& run) { return summary_json(run.input, run.result); })
      .def("events_csv", [](const Finished& run) { return csv_of<SubImpact>(run.result); })
      .def("swept_cells",
           [](const Finished& run) {
             std::string cells;
             NumberWriter numbers;
             append_row(cells, swept_run_columns(), run, numbers);
             cells.pop_back();  // the end of the line
             return cells;
           })
      .def("report_json", [](const Finished& run) { return report_json(run.input, run.result); })
      .def_property_readonly(
          "outcome",
          [](const Finished& run) { return std::string(to_string(run.result.outcome.kind)); })
      .def_property_readonly("message",
                             [](const Finished& run) { return run.result.outcome.message; })
      .def_readonly("interrupted", &Finished::interrupted)
      .def_readonly("timed_out", &Finished::timed_out);
}

}  // namespace subimpact::python
