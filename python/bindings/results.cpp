#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bindings.h"
#include "finished.h"
#include "io/run_tables.h"
#include "subimpact/io/read_results.h"
#include "subimpact/io/report.h"
#include "subimpact/io/results.h"

namespace subimpact::python {
namespace {

// Characters of a cell with words, as NumPy's fixed-width texts have them.
constexpr std::size_t text_width = 16;
constexpr std::int64_t empty_whole = -1;

std::size_t bytes_of(CellType type) { return type == CellType::words ? 4 * text_width : 8; }

const char* numpy_type(CellType type) {
  switch (type) {
    case CellType::real:
      return "f8";
    case CellType::whole:
      return "i8";
    case CellType::words:
      return "U16";
  }
  return "";
}

void store(const Cell& cell, CellType type, char* place) {
  if (type == CellType::words) {
    const auto* words = std::get_if<std::string>(&cell);
    for (std::size_t i = 0; words != nullptr && i < std::min(words->size(), text_width); ++i) {
      const auto character = static_cast<char32_t>((*words)[i]);  // names are ASCII
      std::memcpy(place + 4 * i, &character, 4);
    }
  } else if (type == CellType::whole) {
    const auto* whole = std::get_if<std::int64_t>(&cell);
    const std::int64_t value = whole != nullptr ? *whole : empty_whole;
    std::memcpy(place, &value, sizeof value);
  } else {
    const auto* real = std::get_if<double>(&cell);
    const double value = real != nullptr ? *real : std::numeric_limits<double>::quiet_NaN();
    std::memcpy(place, &value, sizeof value);
  }
}

// A structured array with the columns of a CSV table. Empty cells: NaN, -1, "".
template <class Row>
py::array table(const Columns<Row>& columns, const std::vector<Row>& rows) {
  py::list names, formats, offsets;
  std::vector<std::size_t> places;
  std::size_t row_bytes = 0;
  for (const Column<Row>& column : columns) {
    names.append(column.name);
    formats.append(numpy_type(column.type));
    offsets.append(row_bytes);
    places.push_back(row_bytes);
    row_bytes += bytes_of(column.type);
  }
  py::array array(py::dtype(names, formats, offsets, static_cast<py::ssize_t>(row_bytes)),
                  std::vector<py::ssize_t>{static_cast<py::ssize_t>(rows.size())});
  auto* row_place = static_cast<char*>(array.mutable_data());
  std::memset(row_place, 0, row_bytes * rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i, row_place += row_bytes) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      store(columns[c].cell(rows[i], i), columns[c].type, row_place + places[c]);
    }
  }
  array.attr("flags").attr("writeable") = false;
  return array;
}

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
             return run_summary(run.input, run.result) + '\n' + sub_impact_table(run.result);
           })
      .def("brief", [](const Finished& run) { return run.result.brief_report(); })
      .def("failure",
           [](const Finished& run) {
             return run.result.outcome.completed() ? std::string()
                                                   : failure_message(run.input, run.result);
           })
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
      .def_property_readonly("first_section_yield", member(&Result::first_section_yield))
      .def_property_readonly("first_contact_yield", member(&Result::first_contact_yield))
      .def_property_readonly("max_force", member(&Result::max_force))
      .def_property_readonly("max_indentation", member(&Result::max_indentation))
      .def_property_readonly("residual_indentation", &residual_indentation)
      .def_property_readonly("impulse", &total_impulse)
      .def_property_readonly("striker_velocity", member(&Result::striker_velocity))
      .def_property_readonly("beam_mean_velocity", member(&Result::beam_mean_velocity))
      .def_property_readonly("max_energy_error", member(&Result::max_energy_error))
      .def_property_readonly("wall_seconds",
                             [](const Finished& run) { return run.result.work.wall_seconds; })
      .def_readonly("interrupted", &Finished::interrupted)
      .def_readonly("timed_out", &Finished::timed_out);
}

}  // namespace subimpact::python
