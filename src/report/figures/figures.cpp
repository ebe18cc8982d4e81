#include "subimpact/report/figures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ranges>
#include <string_view>

#include "case/counted.h"
#include "io/directory/listed_files.h"
#include "report/figures/figure_script.h"
#include "report/files.h"
#include "subimpact/report/text.h"

namespace subimpact {
namespace {

std::string sections_left_out(const std::vector<double>& sections) {
  return fmt::format(
      "bending: sections {} to {} of output.sections ({:g}): the figure has room for {}; run the "
      "case again with fewer, or draw them from sections.csv",
      most_bending_panels + 1, sections.size(),
      fmt::join(sections.begin() + most_bending_panels, sections.end(), ", "), most_bending_panels);
}

std::string uncertain_mark(const Result& result) {
  const std::size_t n = result.sub_impacts.size();
  const std::size_t n_certain = result.n_certain().value_or(n);
  if (!result.error_estimate || result.all_certain()) return {};
  if (n_certain == n) return "there may be another sub-impact";
  return fmt::format("{} of {} {} not certain", n - n_certain, counted(n, "sub-impact"),
                     n - n_certain == 1 ? "is" : "are");
}

constexpr const char* script_names[] = {"style",       "tables",   "response", "first-sub-impact",
                                        "indentation", "energies", "timeline", "bending",
                                        "shapes",      "envelope", "strikes"};

// Data of another run would be drawn in place of this one's; files that no manifest lists would
// lie among results.
void refuse_finished_scripts(const std::filesystem::path& directory) {
  constexpr const char* remedy =
      "name a directory of scripts without data; the program puts its own into a new one";
  if (std::filesystem::exists(directory / manifest_name)) {
    throw OutputError(fmt::format("{}: holds results, and cannot be the directory of scripts; {}",
                                  directory.string(), remedy));
  }
  for (const char* name : script_names) {
    const std::filesystem::path file = directory / (std::string(name) + ".gp");
    if (!std::filesystem::exists(file) || !is_finished_script(read_whole_file(file))) continue;
    throw OutputError(
        fmt::format("{}: is the finished script of a drawn figure, with the data of its run, which "
                    "would be drawn in place of those asked for; {}",
                    file.string(), remedy));
  }
}

}  // namespace

std::vector<std::string> figures_left_out(const Case& input, const Result& result) {
  std::vector<std::string> reasons;
  if (result.history.empty()) {
    reasons.push_back(
        "response, first-sub-impact, indentation, energies: the run kept no history; run it again "
        "with output.interval above 0");
  }
  if (result.section_history.empty()) {
    reasons.push_back(
        "bending: the run kept the bending of no section; run it again with --set "
        "output.sections=0.5 (or more positions, as fractions of the length)");
  } else if (input.output.sections.size() > most_bending_panels) {
    reasons.push_back(sections_left_out(input.output.sections));
  }
  if (result.shapes.empty()) {
    reasons.push_back(
        "shapes, envelope: the run kept no shapes; run it again with output.shapes above 0, or "
        "without it");
  }
  return reasons;
}

std::vector<FigureScript> figure_scripts(const Case& input, const Result& result) {
  std::vector<FigureScript> figures;
  if (!result.history.empty()) {
    figures.push_back(response_figure(input, result));
    figures.push_back(first_sub_impact_figure(input, result));
    figures.push_back(indentation_figure(input, result));
    figures.push_back(energies_figure(input, result));
  }
  figures.push_back(timeline_figure(input, result));
  if (!result.section_history.empty()) figures.push_back(bending_figure(input, result));
  if (!result.shapes.empty()) figures.push_back(shapes_figure(input, result));
  if (!result.envelope.empty()) figures.push_back(envelope_figure(input, result));
  if (!result.strikes.empty()) figures.push_back(strikes_figure(input, result));
  const std::string caveat = outcome_caveat(result);
  const std::string uncertain = uncertain_mark(result);
  for (FigureScript& figure : figures) {
    // A line each, because figures are narrow.
    for (const auto clause : std::views::split(caveat, std::string_view("; "))) {
      figure.marks.emplace_back(clause.begin(), clause.end());
    }
    if (!uncertain.empty()) figure.marks.push_back(uncertain);
  }
  return figures;
}

std::vector<std::string> write_figure_scripts(const std::filesystem::path& directory) {
  refuse_finished_scripts(directory);
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) {
    throw OutputError(
        fmt::format("{}: this directory cannot be made ({})", directory.string(), error.message()));
  }
  std::vector<std::string> written;
  for (const char* name : script_names) {
    const std::string file = std::string(name) + ".gp";
    if (std::filesystem::exists(directory / file)) continue;
    write_file(directory / file, std::string(embedded_file("figures/" + file)));
    written.push_back(file);
  }
  return written;
}

DrawnFigures draw_figures(const std::filesystem::path& directory, const Case& input,
                          const Result& result, const std::filesystem::path& scripts,
                          const Overlay* overlay) {
  if (!scripts.empty()) refuse_finished_scripts(scripts);
  DrawnFigures figures;
  figures.left_out = figures_left_out(input, result);
  std::vector<FigureScript> all = figure_scripts(input, result);
  if (overlay != nullptr) all.push_back(measured_figure(*overlay));
  for (const FigureScript& figure : all) {
    try {
      draw_figure(directory, figure.name, figure.text(scripts), figure.size());
      figures.drawn.push_back({figure.name, figure.caption});
    } catch (const GnuplotMissing&) {
      throw;
    } catch (const OutputError& error) {  // not drawn, or not written
      figures.failed.push_back(error.what());
    }
  }
  return figures;
}

bool commit_figures(OutputDirectory& directory, DrawnFigures& figures) {
  while (true) {
    try {
      directory.commit();
      return true;
    } catch (const OutputError& error) {
      std::error_code ignored;
      std::filesystem::remove(directory.staging() / manifest_name, ignored);
      if (figures.drawn.empty()) {
        figures.failed.push_back(error.what());
        return false;
      }
      const std::string name = figures.drawn.back().name;
      remove_figure(directory.staging(), name);
      figures.drawn.pop_back();
      figures.failed.push_back(
          fmt::format("{}: was removed to make room for the others ({})", name, error.what()));
    }
  }
}

void throw_if_failed(const DrawnFigures& figures) {
  if (figures.failed.empty()) return;
  throw FigureError(fmt::format("{}", fmt::join(figures.failed, "\n")));
}

}  // namespace subimpact
