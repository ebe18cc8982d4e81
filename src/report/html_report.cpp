#include "subimpact/report/html_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "case/counted.h"
#include "io/sealed_files.h"
#include "io/sub_impact_rows.h"
#include "io/uncertain.h"
#include "io/write_file.h"
#include "report/chart_library.h"
#include "report/files.h"
#include "report/inlined_svg.h"
#include "report/page_data.h"
#include "report/page_parts.h"
#include "report/strike_words.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"
#include "subimpact/io/report.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace {

using List = FieldList;

List wish_list(const Result& result) {
  if (!result.wish) return {};
  return {Fields{{{"wish", in_print(wish_words(*result.wish, result))},
                  {"class", result.wish->met ? "met" : "warning"}},
                 {}}};
}

// What is certain of a run, and what is not.
List headlines(const Result& result) {
  List list;
  const auto line = [&](bool certain, const std::string& words) {
    list.push_back(headline(certain, words));
  };
  const std::size_t n = result.sub_impacts.size();
  if (const std::optional<std::size_t> n_decided = result.n_decided()) {
    const std::string within =
        result.error_estimate->largest_error > 0.0
            ? ", each start and end within " + error_text(result.error_estimate->largest_error)
            : "";
    if (result.all_decided()) {
      line(true, fmt::format("count and order of all {}{}.", counted(n, "sub-impact"), within));
    } else if (*n_decided > 0) {
      const std::string first = *n_decided == 1 ? "sub-impact" : counted(*n_decided, "sub-impact");
      line(true,
           fmt::format("the first {}, up to {}{}.", first,
                       duration_text(result.end_of(result.sub_impacts[*n_decided - 1])), within));
    }
    if (const std::string reason = undecided_reason(result); !reason.empty()) {
      line(false, fmt::format("what comes from sub-impact {} on: {}.", *n_decided + 1, reason));
    }
  } else {
    line(false, "event times, count and order of sub-impacts: no error bars were computed.");
  }
  if (result.outcome.completed()) {
    line(true, fmt::format("energy is conserved to {:.1e} of its initial value, and every event "
                           "and impulse passed its check.",
                           result.max_energy_error));
  }
  return list;
}

List predictability_list(const Result& result) {
  if (!result.predictability) return {};
  return {Fields{{{"predictability", in_print(predictability_words(result))},
                  {"scatter_table", in_print(scatter_table(result))}},
                 {}}};
}

List neglected_list(const Result& result) {
  if (!result.neglected_shear) return {};
  return {Fields{{{"neglected", in_print(neglected_shear_words(*result.neglected_shear))}}, {}}};
}

List tiles(const Case& input, const Result& result) {
  List list;
  const auto tile = [&](const std::string& value, const std::string& label) {
    list.push_back({{{"value", value}, {"label", label}}, {}});
  };
  const std::size_t n_zones = summarise_zones(result.sub_impacts).size();
  tile(fmt::format("{}", result.sub_impacts.size()),
       noun_after(result.sub_impacts.size(), "sub-impact") + decided_words(result));
  tile(fmt::format("{}", n_zones), noun_after(n_zones, "zone"));
  // With the digits that the error allows; two where it is not known.
  const auto tile_of = [&](double value, double error, const char* unit, const std::string& label) {
    const std::optional<Rounding> rounding = rounding_of(error, 6);
    if (!result.error_estimate) {
      tile(fmt::format("{:.4g} {}", value, unit), label);
    } else if (rounding) {
      tile(fmt::format("{} ± {} {}", with_decimals(value, rounding->decimals), rounding->error,
                       unit),
           label);
    } else {
      tile(fmt::format("{} {}", with_two_digits(value), unit), label + " (error not known)");
    }
  };
  const FinalErrors errors = final_errors(input, result);
  tile_of(1e-3 * result.max_force, 1e-3 * errors.max_force, "kN", "largest force");
  tile_of(1e3 * result.max_indentation, 1e3 * errors.max_indentation, "mm", "largest indentation");
  tile_of(result.striker_velocity, errors.striker_velocity, "m/s", "striker, at the end");
  tile_of(result.beam_mean_velocity, errors.beam_velocity, "m/s", "beam (mean), at the end");
  return list;
}

List figure_list(const DrawnFigures& figures, const std::filesystem::path& figure_directory) {
  List list;
  for (const DrawnFigure& figure : figures.drawn) {
    const std::string svg = read_whole_file(figure_directory / (figure.name + ".svg"));
    list.push_back({{{"name", figure.name},
                     {"svg", inlined_svg(svg, figure.name)},
                     {"number", fmt::format("{}", list.size() + 1)},
                     {"caption", figure.caption}},
                    {}});
  }
  return list;
}

List column_list(const SubImpactRows& table) {
  List list;
  for (const SubImpactRows::Column& column : table.columns) {
    const std::string unit = column.unit;
    list.push_back({{{"name", column.name}, {"unit", unit == "us" ? "µs" : unit}}, {}});
  }
  return list;
}

// A line across the table, where sub-impacts are no longer decided.
List undecided_line(const Result& result, std::size_t n_columns) {
  return {Fields{{{"n_columns", fmt::format("{}", n_columns)},
                  {"undecided_reason", in_print(undecided_reason(result))}},
                 {}}};
}

List sub_impact_list(const Result& result, const SubImpactRows& table) {
  List list;
  const std::size_t n_columns = table.columns.size();
  const std::size_t n_decided = result.n_decided().value_or(table.rows.size());
  int zone = 0, subzone = 0;
  for (const SubImpact& s : result.sub_impacts) {
    const SubImpactRows::Row& row = table.rows[list.size()];
    const bool begins = s.zone != zone || s.subzone != subzone;
    zone = s.zone;
    subzone = s.subzone;
    const Fields heading{{{"n_columns", fmt::format("{}", n_columns)},
                          {"zone", fmt::format("{}", zone)},
                          {"subzone", fmt::format("{}", subzone)}},
                         {}};
    const bool line_before = list.size() == n_decided;
    list.push_back({{{"index", fmt::format("{}", list.size())},
                     {"row_class", row.is_decided ? "" : " class=\"undecided\""}},
                    {{"undecided_from", line_before ? undecided_line(result, n_columns) : List{}},
                     {"subzones", if_given(begins, heading)},
                     {"cells", list_of("cell", row.cells)}}});
  }
  return list;
}

// After the last row, where a refined run has sub-impacts that this run lacks.
List undecided_after(const Result& result, const SubImpactRows& table) {
  const bool all_here = result.n_decided() == table.rows.size();
  return all_here && !undecided_reason(result).empty()
             ? undecided_line(result, table.columns.size())
             : List{};
}

void add_method(Fields& page, const FinishedRun& run) {
  const ResolvedSettings& used = run.result.used;
  const Work& work = run.result.work;
  auto& texts = page.texts;
  texts["mesh"] =
      fmt::format("{}; {} of the beam, {}", used.mesh, counted(used.n_unknowns, "unknown"),
                  counted(used.n_sections, "section"));
  texts["method"] = fmt::format("{}{}", to_string(run.input.solver.method),
                                used.table ? ", table " + *used.table : "");
  texts["step"] = used.step ? duration_text(*used.step) + ", fixed"
                            : fmt::format("adaptive, to {:.2g} m and {:.2g} m/s",
                                          used.position_tolerance, used.velocity_tolerance);
  texts["events"] = to_string(used.events);
  texts["first_period"] = in_print(duration_text(used.first_period));
  texts["work"] =
      fmt::format("{}, {} rejected, {}, {} located; {}", counted(work.steps, "step"),
                  work.rejected_steps, counted(work.right_hand_sides, "right-hand side"),
                  counted(work.roots, "event"), duration_text(work.wall_seconds));
}

Fields error_bars(const ErrorEstimate& estimate) {
  List parts;
  for (const ErrorEstimate::Part& part : estimate.parts) {
    parts.push_back(
        {{{"name", part.name},
          {"run", part.refined_run},
          {"error",
           part.first_unresolved == std::size_t{0} ? "" : in_print(error_text(part.largest_error))},
          {"valid",
           part.first_unresolved
               ? fmt::format(
                     "before sub-impact {}; from there on count and order are uncertain: {}",
                     *part.first_unresolved + 1, in_print(part.reason))
               : "for all sub-impacts"}},
         {}});
  }
  const Fields first{{{"number", fmt::format("{}", estimate.first_unresolved.value_or(0) + 1)}},
                     {}};
  return {
      {},
      {{"parts", parts}, {"uncertain", if_given(estimate.first_unresolved.has_value(), first)}}};
}

void add_conservation(Fields& page, const Result& result) {
  page.texts["initial_energy"] = fmt::format("{:.6g}", result.used.initial_energy);
  page.texts["energy_error"] = fmt::format("{:.1e}", result.max_energy_error);
  page.texts["momentum"] =
      result.max_momentum_error
          ? fmt::format("Total momentum is conserved to within {:.1e}, relative.",
                        *result.max_momentum_error)
          : "The supports take momentum up.";
  page.lists["last_row"] = {};
  if (result.history.empty()) return;
  const HistoryRow& last = result.history.back();
  List energies;
  for (const double energy : {last.striker_energy, last.beam_kinetic_energy, last.bending_elastic,
                              last.bending_plastic, last.contact_elastic, last.contact_plastic}) {
    energies.push_back({{{"energy", fmt::format("{:.5g}", energy)}}, {}});
  }
  page.lists["last_row"] = {
      Fields{{{"time", in_print(duration_text(last.time))}}, {{"energies", energies}}}};
}

}  // namespace

std::string html_report(const FinishedRun& run, const DrawnFigures& figures,
                        const std::filesystem::path& figure_directory,
                        const std::filesystem::path& dygraphs) {
  const Result& result = run.result;
  const Scene& scene = run.input.scene;
  const std::string caveat = outcome_caveat(result);
  const SubImpactRows table = sub_impact_rows(result, "±");
  std::vector<std::string> paragraphs = strike_words(run.input, result);
  std::ranges::transform(paragraphs, paragraphs.begin(), in_print);
  const PageData data = page_data(run.input, result);
  const ChartLibrary charts = chart_library(dygraphs);
  std::string versions = run.program_version;
  for (const auto& [name, version] : run.libraries) versions += ", " + name + " " + version;
  Fields page{
      {{"title", run.input.title.empty() ? "A strike" : run.input.title},
       {"beam_kg", fmt::format("{:.4g}", scene.beam.mass())},
       {"striker_kg", fmt::format("{:.4g}", scene.striker.mass)},
       {"speed_m_per_s", fmt::format("{:.4g}", scene.striker.velocity)},
       {"outcome", std::string(to_string(result.outcome.kind))},
       {"end", in_print(duration_text(result.outcome.time))},
       {"errors", in_print(error_words(run.input, result))},
       {"toml", case_file_text(run.input)},
       {"data", data.json},
       {"history_note", data.history_note},
       {"shapes_note", data.shapes_note},
       {"versions", versions}},
      {{"headlines", headlines(result)},
       {"wishes", wish_list(result)},
       {"predictabilities", predictability_list(result)},
       {"caveats", if_given(!caveat.empty(), {{{"caveat", in_print(caveat)}}, {}})},
       {"warnings", list_of("warning", result.warnings)},
       {"neglected", neglected_list(result)},
       {"tiles", tiles(run.input, result)},
       {"paragraphs", list_of("paragraph", paragraphs)},
       {"figures", figure_list(figures, figure_directory)},
       {"left_out", list_of("reason", figures.left_out)},
       {"failed", list_of("failure", figures.failed)},
       {"columns", column_list(table)},
       {"sub_impacts", sub_impact_list(result, table)},
       {"undecided_after", undecided_after(result, table)},
       {"without_errors", if_given(!result.error_estimate)},
       {"with_errors", if_given(result.error_estimate.has_value(),
                                error_bars(result.error_estimate.value_or(ErrorEstimate{})))}}};
  add_scripts(page, charts, "pages/report.js");
  add_method(page, run);
  add_conservation(page, result);
  return filled(embedded_file("pages/report.html"), page);
}

WrittenReport write_html_report(const std::filesystem::path& directory, const FinishedRun& run,
                                const std::filesystem::path& dygraphs) {
  DrawnFigures figures = draw_figures(directory, run.input, run.result);
  std::filesystem::path path = directory / "report.html";
  try {
    write_file(path, html_report(run, figures, directory, dygraphs));
  } catch (const OutputError& error) {
    figures.failed.push_back(error.what());
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    path.clear();
  }
  return {path, std::move(figures), chart_library(dygraphs).missing};
}

}  // namespace subimpact
