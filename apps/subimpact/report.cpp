#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "subimpact/io/read_sweep.h"
#include "subimpact/io/results.h"
#include "subimpact/report/pages.h"

namespace subimpact::app {
namespace {

struct ReportOptions {
  std::vector<std::string> runs;
  std::string directory;
  std::string dygraphs;
};

int report(const ReportOptions& options) {
  const FinishedRun run = read_results(options.runs.front());
  OutputDirectory directory(options.directory.empty() ? options.runs.front() : options.directory,
                            "figures", run.identity);
  WrittenReport written = write_html_report(directory.staging(), run, options.dygraphs);
  const bool is_there = commit_figures(directory, written.figures) && !written.page.empty();
  if (is_there) print("{}\n", (directory.path() / written.page.filename()).string());
  std::fflush(stdout);
  print_warnings(directory.notes());
  print_figure_notes(run);
  if (!written.charts_missing.empty()) {
    print_error("subimpact: note: no zoomable charts: {}\n", written.charts_missing);
  }
  throw_if_failed(written.figures);
  return done;
}

int finish(OutputDirectory& directory, const char* page) {
  directory.commit();
  print("{}\n", (directory.path() / page).string());
  print_warnings(directory.notes());
  return done;
}

// Several runs: one page that compares them, in a directory of its own.
int compare_runs(const ReportOptions& options) {
  if (options.directory.empty()) {
    throw CLI::ValidationError("DIR",
                               "several runs are given; --out DIR must name the directory "
                               "for the page that compares them");
  }
  std::vector<FinishedRun> runs;
  for (const std::string& run : options.runs) runs.push_back(read_results(run));
  OutputDirectory directory(options.directory, "report");
  write_comparison_report(directory.staging(), runs, options.runs, options.dygraphs);
  return finish(directory, "comparison.html");
}

// The directory of a sweep.
int report_sweep(const ReportOptions& options) {
  const std::string& sweep = options.runs.front();
  const SweptRuns runs = read_sweep(sweep);
  OutputDirectory directory(options.directory.empty() ? sweep : options.directory,
                            runs.identity.empty() ? "report" : "figures", runs.identity);
  write_sweep_report(directory.staging(), runs, sweep);
  return finish(directory, "sweep.html");
}

int report_any(const ReportOptions& options) {
  for (const std::string& run : options.runs) {
    if (!holds_sweep(run)) continue;
    if (options.runs.size() == 1) return report_sweep(options);
    throw CLI::ValidationError(
        "DIR",
        fmt::format("{} holds a sweep, whose page shows all of its runs; give it alone", run));
  }
  return options.runs.size() > 1 ? compare_runs(options) : report(options);
}

}  // namespace

void add_report(CLI::App& program, int& status) {
  CLI::App* command =
      program.add_subcommand("report", "Write finished runs up as one page of HTML");
  auto options = std::make_shared<ReportOptions>();
  command
      ->add_option(
          "DIR", options->runs,
          "Output directory of `subimpact run`, or of subimpact-sweep; several of runs: they "
          "are compared")
      ->required();
  add_directory_option(
      *command, options->directory,
      "Directory for report.html and its figures, comparison.html or sweep.html; made if "
      "missing. Default: DIR; needed with several");
  command->add_option("--dygraphs", options->dygraphs,
                      "Directory of dygraph.min.js and dygraph.css, for the zoomable charts. "
                      "Default: that of Debian's libjs-dygraphs");
  command->footer(
      "report.html needs no other file and no network. In a browser it shows the beam moving, "
      "zoomable charts, force against indentation, a timeline with error bars and the table of "
      "sub-impacts, linked; printed, or without scripts, it is a still report. Figures are drawn "
      "with gnuplot.\n"
      "comparison.html shows the curves of several runs in common charts, the keys in which their "
      "cases differ, and their sub-impacts matched with those of the first.\n"
      "sweep.html shows a map of the runs of a sweep; a click opens the numbers of a run.\n"
      "Examples:\n"
      "  subimpact run case.toml --out out/first --error-bars --set output.sections=0.5,0.4\n"
      "  subimpact report out/first\n"
      "  subimpact report out/first out/second --out out/both\n"
      "Exit status: 0 done; 2 bad command line, files that no run has written, or gnuplot "
      "missing; 3 a figure could not be drawn, the page is written without it; or the page could "
      "not be written, the figures are.");
  command->callback([options, &status] { status = report_any(*options); });
}

}  // namespace subimpact::app
