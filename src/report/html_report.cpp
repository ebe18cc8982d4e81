#include "subimpact/report/pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "case/counted.h"
#include "io/sealed_files.h"
#include "io/sub_impact_rows.h"
#include "io/uncertain.h"
#include "io/write_file.h"
#include "report/files.h"
#include "report/page.h"
#include "report/page_data.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"
#include "subimpact/io/report.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace {

// What is certain of a run, and what is not.
Json headlines(const Result& result) {
  Json list = Json::array();
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

// A number with the digits that the error allows; two where it is not known.
Json number_tile(const Result& result, double value, double error, const char* unit,
                 const char* label) {
  const std::optional<Rounding> rounding = rounding_of(error, 6);
  const bool not_known = result.error_estimate && !rounding;
  const std::string text = !result.error_estimate ? fmt::format("{:.4g}", value)
                           : rounding
                               ? with_decimals(value, rounding->decimals) + " ± " + rounding->error
                               : with_two_digits(value);
  return {{"value", text + " " + unit},
          {"label", fmt::format("{}{}", label, not_known ? " (error not known)" : "")}};
}

Json tiles(const Case& input, const Result& result) {
  const std::size_t n = result.sub_impacts.size();
  const std::size_t n_zones = summarise_zones(result.sub_impacts).size();
  const FinalErrors errors = final_errors(input, result);
  return {
      {{"value", n}, {"label", noun_after(n, "sub-impact") + decided_words(result)}},
      {{"value", n_zones}, {"label", noun_after(n_zones, "zone")}},
      number_tile(result, 1e-3 * result.max_force, 1e-3 * errors.max_force, "kN", "largest force"),
      number_tile(result, 1e3 * result.max_indentation, 1e3 * errors.max_indentation, "mm",
                  "largest indentation"),
      number_tile(result, result.striker_velocity, errors.striker_velocity, "m/s",
                  "striker, at the end"),
      number_tile(result, result.beam_mean_velocity, errors.beam_velocity, "m/s",
                  "beam (mean), at the end")};
}

Json figure_list(const DrawnFigures& figures, const std::filesystem::path& figure_directory) {
  return list_of(figures.drawn, [&, number = 0](const DrawnFigure& figure) mutable -> Json {
    const std::string svg = read_whole_file(figure_directory / (figure.name + ".svg"));
    return {{"name", figure.name},
            {"svg", inlined_svg(svg, figure.name)},
            {"number", ++number},
            {"caption", figure.caption}};
  });
}

// The table of sub-impacts; a line across it stands where they are no longer decided, which may be
// after the last row, if a refined run has sub-impacts that this run lacks.
void add_sub_impacts(Json& page, const Result& result) {
  const SubImpactRows table = sub_impact_rows(result, "±");
  const std::size_t n_decided = result.n_decided().value_or(table.rows.size());
  const std::string reason = undecided_reason(result);
  page["n_columns"] = table.columns.size();
  page["columns"] = list_of(table.columns, [](const SubImpactRows::Column& column) -> Json {
    return {{"name", column.name}, {"unit", column.unit == std::string("us") ? "µs" : column.unit}};
  });
  page["undecided_reason"] = in_print(reason);
  page["undecided_after"] = result.n_decided() == table.rows.size() && !reason.empty();
  Json list = Json::array();
  int zone = 0, subzone = 0;
  for (const SubImpact& s : result.sub_impacts) {
    const SubImpactRows::Row& row = table.rows[list.size()];
    const bool begins = s.zone != zone || s.subzone != subzone;
    zone = s.zone;
    subzone = s.subzone;
    list.push_back({{"index", list.size()},
                    {"row_class", row.is_decided ? "" : " class=\"undecided\""},
                    {"undecided_from", list.size() == n_decided},
                    {"begins", begins},
                    {"zone", zone},
                    {"subzone", subzone},
                    {"cells", row.cells}});
  }
  page["sub_impacts"] = list;
}

Json method_rows(const FinishedRun& run) {
  const ResolvedSettings& used = run.result.used;
  const Work& work = run.result.work;
  const std::pair<const char*, std::string> rows[] = {
      {"mesh", fmt::format("{}; {} of the beam, {}", used.mesh, counted(used.n_unknowns, "unknown"),
                           counted(used.n_sections, "section"))},
      {"method", fmt::format("{}{}", to_string(run.input.solver.method),
                             used.table ? ", table " + *used.table : "")},
      {"step", used.step ? duration_text(*used.step) + ", fixed"
                         : fmt::format("adaptive, to {:.2g} m and {:.2g} m/s",
                                       used.position_tolerance, used.velocity_tolerance)},
      {"events", std::string(to_string(used.events))},
      {"first bending period", in_print(duration_text(used.first_period))},
      {"work", fmt::format("{}, {} rejected, {}, {} located; {}", counted(work.steps, "step"),
                           work.rejected_steps, counted(work.right_hand_sides, "right-hand side"),
                           counted(work.roots, "event"), duration_text(work.wall_seconds))}};
  return list_of(rows, [](const auto& row) -> Json {
    return {{"name", row.first}, {"words", row.second}};
  });
}

Json error_bars(const std::optional<ErrorEstimate>& estimate) {
  if (!estimate) return nullptr;
  const auto part_row = [](const ErrorEstimate::Part& part) -> Json {
    const std::optional<std::size_t>& unresolved = part.first_unresolved;
    return {{"name", part.name},
            {"run", part.refined_run},
            {"error", unresolved == std::size_t{0} ? "" : in_print(error_text(part.largest_error))},
            {"valid", unresolved ? fmt::format("before sub-impact {}; from there on count and "
                                               "order are uncertain: {}",
                                               *unresolved + 1, in_print(part.reason))
                                 : "for all sub-impacts"}};
  };
  const std::optional<std::size_t>& unresolved = estimate->first_unresolved;
  return {{"parts", list_of(estimate->parts, part_row)},
          {"uncertain", unresolved ? Json(*unresolved + 1) : Json(nullptr)}};
}

void add_conservation(Json& page, const Result& result) {
  page["initial_energy"] = fmt::format("{:.6g}", result.used.initial_energy);
  page["energy_error"] = fmt::format("{:.1e}", result.max_energy_error);
  page["momentum"] = result.max_momentum_error
                         ? fmt::format("Total momentum is conserved to within {:.1e}, relative.",
                                       *result.max_momentum_error)
                         : "The supports take momentum up.";
  page["last_row"] = nullptr;
  if (result.history.empty()) return;
  const HistoryRow& last = result.history.back();
  const double energies[] = {last.striker_energy,  last.beam_kinetic_energy, last.bending_elastic,
                             last.bending_plastic, last.contact_elastic,     last.contact_plastic};
  page["last_row"] = {
      {"time", in_print(duration_text(last.time))},
      {"energies", list_of(energies, [](double x) { return fmt::format("{:.5g}", x); })}};
}

}  // namespace

std::string html_report(const FinishedRun& run, const DrawnFigures& figures,
                        const std::filesystem::path& figure_directory,
                        const std::filesystem::path& dygraphs) {
  const Result& result = run.result;
  const Scene& scene = run.input.scene;
  const PageData data = page_data(run.input, result);
  std::string versions = run.program_version;
  for (const auto& [name, version] : run.libraries) versions += ", " + name + " " + version;
  const auto if_any = [](const auto& value, auto words) {
    return value ? in_print(words(*value)) : std::string();
  };
  Json page = {
      {"title", run.input.title.empty() ? "A strike" : run.input.title},
      {"beam_kg", fmt::format("{:.4g}", scene.beam.mass())},
      {"striker_kg", fmt::format("{:.4g}", scene.striker.mass)},
      {"speed_m_per_s", fmt::format("{:.4g}", scene.striker.velocity)},
      {"outcome", to_string(result.outcome.kind)},
      {"end", in_print(duration_text(result.outcome.time))},
      {"errors", in_print(error_words(run.input, result))},
      {"toml", case_file_text(run.input)},
      {"data", data.json},
      {"history_note", data.history_note},
      {"shapes_note", data.shapes_note},
      {"versions", versions},
      {"headlines", headlines(result)},
      {"wish", if_any(result.wish, [&](const auto& wish) { return wish_words(wish, result); })},
      {"wish_class", result.wish && result.wish->met ? "met" : "warning"},
      {"predictability",
       if_any(result.predictability, [&](const auto&) { return predictability_words(result); })},
      {"scatter_table",
       if_any(result.predictability, [&](const auto&) { return scatter_table(result); })},
      {"caveat", in_print(outcome_caveat(result))},
      {"warnings", result.warnings},
      {"neglected", if_any(result.neglected_shear, neglected_shear_words)},
      {"tiles", tiles(run.input, result)},
      {"paragraphs", list_of(strike_words(run.input, result), in_print)},
      {"figures", figure_list(figures, figure_directory)},
      {"left_out", figures.left_out},
      {"failed", figures.failed},
      {"error_bars", error_bars(result.error_estimate)},
      {"method", method_rows(run)},
      {"no_error_bars", !result.error_estimate}};
  add_sub_impacts(page, result);
  add_conservation(page, result);
  return whole_page(
      "pages/report.html", page, chart_library(dygraphs),
      {"pages/data.js", "pages/axes.js", "pages/motion.js", "pages/panels.js", "pages/report.js"});
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
