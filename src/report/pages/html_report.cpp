#include "subimpact/report/pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <regex>

#include "case/counted.h"
#include "io/directory/listed_files.h"
#include "io/records/record.h"
#include "io/records/run_record.h"
#include "report/pages/page.h"
#include "report/text/uncertain.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"
#include "subimpact/report/text.h"

namespace subimpact {
namespace {

// Why sub-impacts from `first` on are not certain, as far as they have reasons of their own.
void add_doubts(const Result& result, std::size_t first, const auto& line) {
  constexpr std::size_t most_doubts = 8;
  std::size_t n = 0;
  for (std::size_t i = first; i < result.sub_impacts.size(); ++i) {
    const SubImpact& s = result.sub_impacts[i];
    if (s.certain.value_or(true) || !s.doubt) continue;
    if (++n <= most_doubts)
      line(false, fmt::format("sub-impact {}: {}.", i + 1, words_of(s.doubt)));
  }
  if (n > most_doubts) line(false, counted(n - most_doubts, "more sub-impact") + ".");
}

Json headlines(const Result& result) {
  Json list = Json::array();
  const auto line = [&](bool certain, const std::string& words) {
    list.push_back(headline(certain, words));
  };
  const std::size_t n = result.sub_impacts.size();
  if (const std::optional<std::size_t> n_certain = result.n_certain()) {
    const std::string within =
        result.error_estimate->largest_error > 0.0
            ? ", each start and end within " + error_text(result.error_estimate->largest_error)
            : "";
    if (result.all_certain() && n == 0) {
      line(true, "that there are no sub-impacts.");
    } else if (result.all_certain()) {
      line(true,
           fmt::format("{}{}, and that there are no others.",
                       n == 1 ? "the one sub-impact" : "all " + counted(n, "sub-impact"), within));
    } else {
      if (*n_certain > 0) {
        line(true, fmt::format("{} of {}{}.", *n_certain, counted(n, "sub-impact"), within));
      }
      const ErrorEstimate& estimate = *result.error_estimate;
      line(false,
           fmt::format("{}: {}.", place_of_doubt(result, estimate), words_of(estimate.reason)));
      add_doubts(result, *estimate.first_unresolved + 1, line);
    }
  } else {
    line(false, "event times, count and order of sub-impacts: no error bars were computed.");
  }
  line(result.contact_over, "the end of contact: " + contact_over_words(result) + ".");
  if (result.error_estimate && result.error_estimate->finer_meshes) {
    line(false, finer_meshes_words(result) + ".");
  }
  return list;
}

Json tiles(const std::vector<LabelledText>& all) {
  return list_of(all, [](const LabelledText& answer) -> Json {
    return {
        {"name", answer.label}, {"value", in_print(answer.text)}, {"note", in_print(answer.note)}};
  });
}

// Whether the run is sure of its sub-impacts and of the end of contact, in one line without
// numbers.
std::string verdict(const Result& result) {
  const bool known = result.error_estimate.has_value(), all = known && result.all_certain();
  return fmt::format("{}{}, {} contact {}.",
                     all     ? "All sub-impacts are certain"
                     : known ? "Not all sub-impacts are certain"
                             : "How certain the sub-impacts are is not known",
                     known && result.error_estimate->finer_meshes ? " on this mesh" : "",
                     all == result.contact_over ? "and" : "but",
                     result.contact_over ? "is over"
                     : result.sub_impacts.empty() || result.sub_impacts.back().end
                         ? "may not be over"
                         : "is not over");
}

// The verdict and what opens below it.
void add_certainty(Json& page, const Result& result) {
  const Json lines = headlines(result);
  const auto n_doubts = static_cast<std::size_t>(
      std::ranges::count(lines, Json("not"), [](const Json& line) { return line.at("kind"); }));
  const std::size_t n_warnings = result.warnings.size();
  std::string opens = n_doubts > 0 ? counted(n_doubts, "doubt") : "";
  if (n_warnings > 0) opens += (opens.empty() ? "" : ", ") + counted(n_warnings, "warning");
  page["headlines"] = lines;
  page["verdict"] = verdict(result);
  page["verdict_class"] = opens.empty() ? "certain" : "not";
  page["verdict_opens"] = opens.empty() ? "Why" : opens;
}

Json next_steps(const Result& result) {
  return list_of(result.next_steps, [](const NextStep& step) -> Json {
    return {{"command", step.command}, {"gain", in_print(step.gain)}};
  });
}

Result with_answers(const FinishedRun& run) {
  Result result = run.result;
  make_answers(run.input, result);
  return result;
}

// Answers of the first screen, those about the model, all others.
void add_answers(Json& page, const Result& result) {
  std::vector<LabelledText> first, model, further;
  for (const Answer& answer : result.answers) {
    if (!answer.value) continue;
    using enum AnswerKey;
    const bool is_first = answer.key == sub_impacts || answer.key == largest_force ||
                          answer.key == permanent_set || answer.key == contact_end;
    (is_first ? first : further).push_back({answer.label, answer.text, answer.note});
    const std::string errors = "+- " + answer.error_text + " computed, +- " + answer.body_text;
    if (!answer.parts.empty()) model.push_back({answer.label, answer.text, errors + " body"});
  }
  page["tiles"] = tiles(first);
  page["further"] = tiles(further);
  page["model"] = tiles(model);
  page["has_model"] = !model.empty();
}

Json figure_list(const std::vector<DrawnFigures::Figure>& figures) {
  return list_of(figures, [number = 0](const auto& figure) mutable -> Json {
    return {{"name", figure.name},
            {"svg", inlined_svg(figure.svg, figure.name)},
            {"number", ++number},
            {"caption", figure.caption}};
  });
}

void add_sub_impacts(Json& page, const Result& result) {
  const SubImpactRows table = sub_impact_rows(result, "±");
  page["n_columns"] = table.columns.size();
  page["columns"] = list_of(table.columns, [](const SubImpactRows::Column& column) -> Json {
    return {{"name", column.name},
            {"unit", column.unit.starts_with("u") ? "µ" + column.unit.substr(1) : column.unit}};
  });
  Json list = Json::array();
  int zone = 0, subzone = 0;
  for (const SubImpact& s : result.sub_impacts) {
    const SubImpactRows::Row& row = table.rows[list.size()];
    const bool begins = s.zone != zone || s.subzone != subzone;
    zone = s.zone;
    subzone = s.subzone;
    list.push_back({{"index", list.size()},
                    {"row_class", row.is_certain ? "" : " class=\"uncertain\""},
                    {"doubt", in_print(words_of(s.doubt))},
                    {"begins", begins},
                    {"zone", zone},
                    {"subzone", subzone},
                    {"cells", row.cells}});
  }
  page["sub_impacts"] = list;
}

Json flights(const std::optional<ErrorEstimate>& estimate) {
  if (!estimate) return nullptr;
  return list_of(estimate->uncertain_flights, [](const auto& flight) -> Json {
    return {{"after", flight.after + 1}, {"reason", in_print(words_of(flight.reason))}};
  });
}

// Whether an SVG file is a picture and nothing more: results may come from anywhere.
bool is_still(const std::string& svg) {
  static const std::regex active(
      R"(<(script|foreignObject|iframe|image|a|style)\b|\son\w+\s*=|href\s*=\s*["'][^#]|url\((?!#)|<!ENTITY)",
      std::regex::icase);
  return svg.starts_with("<") && svg.find("<svg") != svg.npos && !std::regex_search(svg, active);
}

/// What Python found of a measured force. Moves of Json throw nothing.
struct Measured {  // NOLINT(bugprone-exception-escape)
  Json section;    ///< of the page
  Json forces;     ///< for its chart
  DrawnFigures::Figure figure;
};

Measured read_measured(const std::filesystem::path& directory) {
  Measured measured;
  if (directory.empty()) return measured;
  const std::filesystem::path path = directory / "measured.json";
  read_json(path, read_whole_file(path), "a comparison with a measurement", "report again",
            [&](const auto& json) {
              std::vector<LabelledText> found;
              for (const auto& answer : json.at("answers")) {
                found.push_back({answer.at("name"), answer.at("value"), answer.at("note")});
              }
              const std::string doubt = json.at("doubt");
              const bool is_strain = json.at("quantity") == "strain";
              measured.section = {{"answers", tiles(found)},
                                  {"doubt", in_print(doubt)},
                                  {"what", is_strain ? "strain" : "contact force"},
                                  {"strain", is_strain}};
              measured.figure = {"measured", json.at("caption"),
                                 read_whole_file(directory / "measured.svg")};
              measured.forces = json.at("overlay");
            });
  return measured;
}

}  // namespace

DrawnFigures read_figures(const std::filesystem::path& directory, const std::string& identity) {
  constexpr const char* list = "figures.json";
  DrawnFigures figures;
  const std::optional<Manifest> manifest = read_manifest(directory);
  if (!manifest || manifest->identity != identity || !manifest->files.contains(list))
    return figures;
  const auto is_as_drawn = [&](const std::string& name) {
    const auto listed = manifest->files.find(name);
    return listed != manifest->files.end() && fingerprint_of(directory / name) == listed->second;
  };
  if (!is_as_drawn(list)) return figures;
  read_json(directory / list, read_whole_file(directory / list), "a list of figures", "",
            [&](const auto& json) {
              for (const auto& entry : json.at("figures")) {
                const std::string name = entry.at("name"), file = name + ".svg";
                const std::string svg = is_as_drawn(file) ? read_whole_file(directory / file) : "";
                if (is_still(svg)) {
                  figures.drawn.push_back({name, entry.at("caption"), svg});
                } else {
                  figures.left_out.push_back(name + ": has no SVG file, or one that was changed");
                }
              }
              for (const auto& reason : json.at("left_out")) {
                figures.left_out.push_back(reason.template get<std::string>());
              }
            });
  return figures;
}

std::string html_report(const FinishedRun& run, const DrawnFigures& figures,
                        const std::filesystem::path& dygraphs,
                        const std::filesystem::path& measured) {
  const Result& result = run.result;
  const Scene& scene = run.input.scene;
  const Measured comparison = read_measured(measured);
  std::vector<DrawnFigures::Figure> drawn = figures.drawn;
  if (!measured.empty()) drawn.push_back(comparison.figure);
  const PageData data = page_data(run.input, result, comparison.forces);
  std::string versions = run.program_version;
  for (const auto& [name, version] : run.libraries)
    versions += fmt::format(", {} {}", name, version);
  const auto if_any = [](const auto& value, auto words) {
    return value ? in_print(words(*value)) : std::string();
  };
  Json page = {
      {"title", run.input.title.empty() ? "A strike" : run.input.title},
      {"body", scene.beam.fixed ? "plane" : fmt::format("beam of {:.4g} kg", scene.beam.mass())},
      {"meeting", scene.striker.fixed
                      ? std::string("on a stop")
                      : fmt::format("struck by {:.4g} kg at {:.4g} m/s", scene.striker.mass,
                                    scene.bodies().striker_velocity())},
      {"besides", others_in_scene(scene).empty() ? "" : " (" + others_in_scene(scene) + ")"},
      {"outcome", to_string(result.outcome.kind)},
      {"end", in_print(duration_text(result.outcome.time))},
      {"toml", case_file_text(run.input)},
      {"data", data.json},
      {"history_note", data.history_note},
      {"shapes_note", data.shapes_note},
      {"versions", versions},
      {"tolerance",
       if_any(result.tolerance, [&](const auto& t) { return tolerance_words(t, result); })},
      {"tolerance_class", result.tolerance && result.tolerance->met ? "met" : "warning"},
      {"scatter_table",
       if_any(result.predictability, [&](const auto&) { return scatter_table(result); })},
      {"predictability",
       if_any(result.predictability, [&](const auto&) { return predictability_words(result); })},
      {"caveat", in_print(outcome_caveat(result))},
      {"cause", result.outcome.completed() ? "" : in_print(result.outcome.message)},
      {"warnings",
       list_of(result.warnings, [](const auto& words) { return Json(in_print(words)); })},
      {"next_steps", next_steps(result)},
      {"has_next", !result.next_steps.empty()},
      {"measured", comparison.section},
      {"flights", flights(result.error_estimate)},
      {"summary", in_print(run_summary(run.input, with_answers(run), true))},
      {"figures", figure_list(drawn)},
      {"no_figures", drawn.empty()},
      {"left_out", figures.left_out},
      {"numbers", list_of(scalars_of(run), [](const NamedScalar& scalar) -> Json {
         return {{"name", scalar.name}, {"value", scalar.value}, {"meaning", scalar.meaning}};
       })}};
  add_certainty(page, result);
  add_answers(page, with_answers(run));
  add_sub_impacts(page, result);
  return whole_page("pages/web/report.html", page, chart_library(dygraphs),
                    {"pages/web/data.js", "pages/web/axes.js", "pages/web/surroundings.js",
                     "pages/web/motion.js", "pages/web/panels.js", "pages/web/report.js"});
}

std::string why_no_charts(const std::filesystem::path& dygraphs) {
  return chart_library(dygraphs).missing;
}

}  // namespace subimpact
