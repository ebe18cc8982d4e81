#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "commands.h"
#include "subimpact/io/read_results.h"
#include "subimpact/io/results.h"
#include "subimpact/report/figures.h"

namespace subimpact::app {
namespace {

struct PlotOptions {
  std::string run;
  std::string directory;
  std::string scripts;
};

// Results and scripts to be changed are not to lie among each other.
void check_scripts(const std::string& scripts, const std::vector<std::filesystem::path>& taken) {
  for (const std::filesystem::path& directory : taken) {
    std::error_code none;  // of those names
    if (!std::filesystem::equivalent(scripts, directory, none)) continue;
    throw CLI::ValidationError(
        "--scripts", fmt::format("{} is the directory of the run or of its figures; name another, "
                                 "for scripts alone; it is made if missing",
                                 scripts));
  }
}

int plot(const PlotOptions& options) {
  const FinishedRun run = read_results(options.run);
  OutputDirectory directory(options.directory.empty() ? options.run : options.directory, "figures",
                            run.identity);
  if (!options.scripts.empty()) {
    check_scripts(options.scripts, {options.run, directory.path()});
    for (const std::string& file : write_figure_scripts(options.scripts)) {
      print("{}\n", (std::filesystem::path(options.scripts) / file).string());
    }
  }
  DrawnFigures figures = draw_figures(directory.staging(), run.input, run.result, options.scripts);
  commit_figures(directory, figures);
  for (const DrawnFigure& figure : figures.drawn) {
    print("{0}.svg, {0}.png, {0}.pdf\n    {1}\n", figure.name, figure.caption);
  }
  if (!figures.drawn.empty()) print("\nfigures in {}\n", directory.path().string());
  std::fflush(stdout);
  print_warnings(directory.notes());
  print_figure_notes(run);
  throw_if_failed(figures);
  return done;
}

}  // namespace

void add_plot(CLI::App& program, int& status) {
  CLI::App* command =
      program.add_subcommand("plot", "Draw the figures of a finished run (SVG, PNG and PDF)");
  auto options = std::make_shared<PlotOptions>();
  command->add_option("DIR", options->run, "Output directory of `subimpact run`")->required();
  add_directory_option(*command, options->directory,
                       "Directory for the figures; made if missing. Default: DIR");
  command->add_option("--scripts", options->scripts,
                      "Directory of gnuplot scripts to draw with; those it lacks are put there "
                      "first, to be changed. For scripts alone: not that of a run or of figures");
  command->footer(
      "Draws response, first-sub-impact, indentation, energies, timeline, shapes and envelope "
      "(both unless output.shapes = 0) and, if the run kept sections (output.sections), bending; "
      "needs "
      "gnuplot. The gnuplot scripts stay beside the "
      "figures, ready to be edited and run again.\n"
      "Examples:\n"
      "  subimpact run case.toml --out out/first --set output.sections=0.5,0.4\n"
      "  subimpact plot out/first\n"
      "  subimpact plot out/first --out figures\n"
      "  subimpact plot out/first --scripts mine    (change mine/style.gp, and repeat)\n"
      "Exit status: 0 done; 2 bad command line, files that no run has written, or gnuplot "
      "missing; 3 a figure could not be drawn or written, the others are.");
  command->callback([options, &status] { status = plot(*options); });
}

}  // namespace subimpact::app
