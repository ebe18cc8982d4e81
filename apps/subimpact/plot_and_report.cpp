#include <cmath>

#include "case/keys/units.h"
#include "commands.h"
#include "io/directory/listed_files.h"
#include "python.h"
#include "subimpact/io/read_results.h"
#include "subimpact/io/results.h"
#include "subimpact/report/pages.h"
#include "subimpact/report/text.h"
#include "subimpact/study/overlay.h"

namespace subimpact::app {
namespace {

namespace fs = std::filesystem;

struct FinishedRunOptions {
  std::vector<std::string> runs;
  std::string directory;
  std::string dygraphs;
  std::string measured, shift, low_pass;

  const std::string& directory_or_first_run() const {
    return directory.empty() ? runs.front() : directory;
  }
};

struct PlotOptions {
  std::string directory, out, formats, only;
};

int plot(PlotOptions& options) {
  std::vector<std::string> arguments;
  for (const auto& [name, value] :
       {std::pair("--out=", options.out), std::pair("--format=", options.formats),
        std::pair("--only=", options.only)}) {
    if (!value.empty()) arguments.push_back(name + value);
  }
  arguments.insert(arguments.end(), {"--", options.directory});
  return run_python("subimpact.plot", arguments);
}

constexpr const char* find_cutoff = "find";

std::optional<Overlay> overlay_with(const FinishedRun& run, const FinishedRunOptions& options) {
  if (options.measured.empty()) return std::nullopt;
  OverlayOptions how;
  how.shift = value_in("s", options.shift);
  how.find_low_pass = options.low_pass == find_cutoff;
  how.low_pass = value_in("Hz", options.low_pass);
  return overlay_of(run.result.history, read_signal(options.measured), how);
}

void print_overlay(const Overlay& overlay) {
  for (const auto& [name, value, note] : answers(overlay)) {
    print("  {:<18}  {}\n{:22}{}\n", name, value, "", note);
  }
  if (const std::string doubt = overlay_doubt(overlay); !doubt.empty()) print_warnings({doubt});
}

int write_page(OutputDirectory& directory, const char* file, const std::string& page) {
  write_file(directory.staging() / file, page);
  directory.commit();
  print("{}\n", (directory.path() / file).string());
  print_warnings(directory.notes());
  return done;
}

int report(const FinishedRunOptions& options) {
  const FinishedRun run = read_results(options.runs.front());
  const std::optional<Overlay> overlay = overlay_with(run, options);
  OutputDirectory directory(options.directory_or_first_run(), "figures", run.identity);
  const DrawnFigures figures =
      read_figures(fs::path(options.runs.front()) / "figures", run.identity);
  write_page(directory, "report.html",
             html_report(run, figures, options.dygraphs, overlay ? &*overlay : nullptr));
  if (overlay) print_overlay(*overlay);
  std::fflush(stdout);
  if (const std::string caveat = outcome_caveat(run.result); !caveat.empty()) {
    print_warnings({caveat});
  }
  if (const std::string missing = why_no_charts(options.dygraphs); !missing.empty()) {
    print_error("subimpact: note: no zoomable charts: {}\n", missing);
  }
  return done;
}

// Several runs: one page that compares them, in a directory of its own.
int compare_runs(const FinishedRunOptions& options) {
  if (options.directory.empty()) {
    throw CLI::ValidationError("DIR",
                               "several runs are given; --out DIR must name the directory "
                               "for the page that compares them");
  }
  std::vector<FinishedRun> runs;
  for (const std::string& run : options.runs) runs.push_back(read_results(run));
  OutputDirectory directory(options.directory, "report");
  return write_page(directory, "comparison.html",
                    comparison_report(runs, options.runs, options.dygraphs));
}

int report_sweep(const FinishedRunOptions& options) {
  const std::string& sweep = options.runs.front();
  const SweptRuns runs = read_sweep(sweep);
  OutputDirectory directory(options.directory_or_first_run(),
                            runs.identity.empty() ? "report" : "figures", runs.identity);
  return write_page(directory, "sweep.html", sweep_report(runs, sweep));
}

int report_any(FinishedRunOptions& options) {
  if (!options.measured.empty() && (options.runs.size() > 1 || holds_sweep(options.runs.front()))) {
    throw CLI::ValidationError("--measured", "is compared with one run; give its directory alone");
  }
  for (const std::string& run : options.runs) {
    if (!holds_sweep(run)) continue;
    if (options.runs.size() == 1) return report_sweep(options);
    throw CLI::ValidationError(
        "DIR",
        fmt::format("{} holds a sweep, whose page shows all of its runs; give it alone", run));
  }
  return options.runs.size() > 1 ? compare_runs(options) : report(options);
}

void add_plot(CLI::App& program, int& status) {
  auto [command, options] =
      add_command(program, status, "plot",
                  "Draw the figures of a run, a sweep or a study (SVG, PNG and PDF)", plot);
  command
      .add_option("DIR", options.directory,
                  "Output directory of `subimpact run`, `stability` or `work-precision`, or of "
                  "subimpact-sweep")
      ->required();
  add_directory_option(command, options.out,
                       "Directory for the figures; made if missing. Default: DIR/figures");
  command
      .add_option("--format", options.formats,
                  "File formats, separated by commas. Default: svg,png,pdf")
      ->check(not_empty);
  command
      .add_option("--only", options.only,
                  "Names of figures, separated by commas. Default: all there are")
      ->check(not_empty);
  command.footer(
      "Of a run: response, first-sub-impact, indentation, energies, timeline, shapes and envelope "
      "(both unless output.shapes = 0), bending, if the run kept sections (output.sections), and "
      "strikes, if there were several. Of a sweep: sweep_map, histograms. figures.json has their "
      "captions; `subimpact report` puts the figures of a run on its page. Needs Python with "
      "Matplotlib, where the package subimpact.plot draws them.\n"
      "Examples:\n"
      "  subimpact run case.toml --out out/first --set output.sections=0.5,0.4\n"
      "  subimpact plot out/first\n"
      "  subimpact plot out/first --out figures --format pdf --only response,timeline\n"
      "Exit status: 0 done; 2 bad command line, files that no run has written, or Python without "
      "what is needed; 3 a figure could not be drawn or written, the others are.");
}

bool is_finite_time(const std::string& text) {
  const std::optional<double> seconds = value_in("s", text);
  return seconds && std::isfinite(*seconds);
}

bool is_cutoff(const std::string& text) {
  const std::optional<double> frequency = value_in("Hz", text);
  return text == find_cutoff || (frequency && std::isfinite(*frequency) && *frequency > 0.0);
}

void add_report(CLI::App& program, int& status) {
  auto [command, options] =
      add_command(program, status, "report", "Write finished runs as one page of HTML", report_any);
  command
      .add_option(
          "DIR", options.runs,
          "Output directory of `subimpact run`, or of subimpact-sweep; several of runs: they "
          "are compared")
      ->required();
  add_directory_option(
      command, options.directory,
      "Directory for report.html, comparison.html or sweep.html; made if missing. Default: DIR; "
      "needed with several");
  command.add_option("--dygraphs", options.dygraphs,
                     "Directory of dygraph.min.js and dygraph.css, for the zoomable charts. "
                     "Default: that of Debian's libjs-dygraphs");
  CLI::Option* measured = command.add_option("--measured", options.measured,
                                             "CSV file of a measured force, to compare with the "
                                             "computed one; its heading has the units: "
                                             "time_us,force_kN");
  measured->check(not_empty);
  command
      .add_option("--shift", options.shift,
                  "By how much the measured time is later than that of the run, with its unit: "
                  "-12.5us. Default: found, where the two forces correlate most")
      ->needs(measured)
      ->check(refused_unless(is_finite_time, "a time with its unit, such as 12.5us or -3ms"));
  command
      .add_option(
          "--low-pass", options.low_pass,
          "Cut-off of the transducer, with its unit: 20kHz; the computed force is filtered "
          "by a Butterworth low-pass of fourth order. \"find\": the cut-off is found, where "
          "the two forces correlate most. Default: no filter")
      ->needs(measured)
      ->check(
          refused_unless(is_cutoff, "a frequency above 0 with its unit, such as 20kHz, or find"));
  command.footer(
      "report.html needs no other file and no network. In a browser it shows the beam moving, "
      "zoomable charts, force against indentation, a timeline with error bars and the table of "
      "sub-impacts, linked; printed, or without scripts, it is a still report. It has the figures "
      "that `subimpact plot DIR` has drawn before.\n"
      "comparison.html shows the curves of several runs in common charts, the keys in which their "
      "cases differ, and their sub-impacts matched with those of the first.\n"
      "sweep.html shows a map of the runs of a sweep; a click opens the numbers of a run.\n"
      "Examples:\n"
      "  subimpact run case.toml --out out/first --error-bars --set output.sections=0.5,0.4\n"
      "  subimpact plot out/first; subimpact report out/first\n"
      "  subimpact report out/first out/second --out out/both\n"
      "  subimpact report out/first --measured force.csv --low-pass 20kHz\n"
      "Exit status: 0 done; 2 bad command line, files that no run has written, or a page that "
      "cannot be written.");
}

}  // namespace

void add_plot_and_report(CLI::App& program, int& status) {
  add_plot(program, status);
  add_report(program, status);
}

}  // namespace subimpact::app
