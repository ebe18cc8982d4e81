#include <algorithm>

#include "commands.h"
#include "io/directory/listed_files.h"
#include "simulate/settings/refuse.h"

namespace subimpact::app {
namespace {

namespace fs = std::filesystem;

struct FinishedRunOptions {
  std::vector<std::string> runs;
  std::string directory;
  std::string dygraphs = SUBIMPACT_DYGRAPHS;
  std::string measured;
  std::vector<std::string> how_measured;  // one a row of `measured_options`
};

// Of subimpact.measured, which checks the values: names and meanings.
constexpr std::pair<const char*, const char*> measured_options[] = {
    {"--shift", "How much later the measured time is: -12.5us. Default: found"},
    {"--low-pass", "Cut-off of the transducer, 20kHz or \"find\". Default: no filter"},
    {"--gain", "Measured over true force, or \"find\". Default: 1"},
    {"--gauge", "Of a measured strain: the gauge in output.gauges, from 1. Default: 1"},
    {"--columns", "Columns of time and force in the file, by number or name: 1,3"},
    {"--units", "Units of time and force, where the file states none: us,kN"},
    {"--scale", "What the force is multiplied by"},
    {"--sign", "-1: the file has compression negative"},
    {"--sensitivity", "Of a transducer in volts or coulombs: \"2.27 mV/N\""},
    {"--mass", "Of the body whose acceleration was measured: \"201 g\""},
    {"--interval", "Between samples, in place of a column of times: 1us"},
    {"--skip", "Lines at the top of the file that are not read"},
    {"--rows", "Rows of the file that are read. Default: all"},
    {"--separator", "Of cells: \",\", \";\", tab or \" \". Default: found"},
    {"--decimal", "\".\" or \",\". Default: found"}};

int compare_with_measured(const FinishedRunOptions& options, const fs::path& directory) {
  std::vector<std::string> arguments = {"--measured=" + options.measured,
                                        "--out=" + directory.string()};
  for (std::size_t i = 0; i < std::size(measured_options); ++i) {
    const std::string& value = options.how_measured[i];
    if (!value.empty()) arguments.push_back(std::string(measured_options[i].first) + '=' + value);
  }
  arguments.insert(arguments.end(), {"--", options.runs.front()});
  return run_python("subimpact.measured", arguments);
}

// Writes the page of a run or a sweep, or one that compares several runs.
int report(FinishedRunOptions& options) {
  const bool several = options.runs.size() > 1;
  const std::string& first = options.runs.front();
  const auto is_sweep = [](const fs::path& path) {
    return fs::exists(path / "runs.csv") && !fs::exists(path / "summary.json");
  };
  if (!options.measured.empty() && (several || is_sweep(first))) {
    throw UsageError("--measured", "is compared with one run; give its directory alone");
  }
  if (several && std::ranges::any_of(options.runs, is_sweep)) {
    throw UsageError("DIR", "a sweep, whose page shows all of its runs, is given alone");
  }
  if (several && options.directory.empty()) {
    throw UsageError("DIR",
                     "several runs are given; --out DIR must name the directory "
                     "for the page that compares them");
  }
  if (!fs::is_directory(first)) {
    fail<ResultsError>(
        "{}: is not a directory; give the output directory of `subimpact run` (--out)", first);
  }
  const fs::path place = options.directory.empty() ? first : options.directory,
                 figures = place / "figures";
  if (!options.measured.empty()) {
    if (const int status = compare_with_measured(options, figures); status != done) return status;
  }
  const std::optional<Manifest> manifest = several ? std::nullopt : read_manifest(first);
  OutputDirectory directory(place, manifest ? "figures" : "report",
                            manifest ? manifest->identity : new_identity());
  std::vector<std::string> arguments = {"--out=" + directory.staging().string(),
                                        "--dygraphs=" + options.dygraphs};
  if (!options.measured.empty()) arguments.push_back("--measured=" + figures.string());
  arguments.emplace_back("--");
  arguments.insert(arguments.end(), options.runs.begin(), options.runs.end());
  if (const int status = run_python("subimpact.page", arguments); status != done) return status;
  const fs::path page = fs::directory_iterator(directory.staging())->path().filename();
  directory.commit();
  print("{}\n", (directory.path() / page).string());
  return done;
}

std::vector<Option> options_of(FinishedRunOptions& options) {
  Option runs = {"DIR", &options.runs,
                 "Output directory of `subimpact run`, or of subimpact-sweep; several of runs: "
                 "they are compared"};
  runs.is_required = true;
  runs.list = Option::List::all_that_follow;
  std::vector<Option> list = {
      runs,
      of_directory(options.directory,
                   "Directory for report.html, comparison.html or sweep.html; made if missing. "
                   "Default: DIR; needed with several"),
      {"--dygraphs", &options.dygraphs,
       "Directory of dygraph.min.js and dygraph.css, for the zoomable charts. Default: that of "
       "Debian's libjs-dygraphs"},
      {"--measured", &options.measured,
       "File of a measured force as an instrument or a spreadsheet writes it, to compare with "
       "the computed one. One that states what it holds needs no other option",
       not_empty}};
  options.how_measured.resize(std::size(measured_options));
  for (std::size_t i = 0; i < std::size(measured_options); ++i) {
    const auto& [name, meaning] = measured_options[i];
    list.push_back({name, &options.how_measured[i], meaning, not_empty});
    list.back().needs = "--measured";
  }
  return list;
}

}  // namespace

Command report_command() {
  return command_with(
      "report", "Write finished runs as one page of HTML", report, options_of,
      "report.html needs no other file and no network. In a browser it shows the beam moving, "
      "zoomable charts, force against indentation, a timeline with error bars and the table of "
      "sub-impacts, linked; printed, or without scripts, it is a still report, with the figures "
      "that `subimpact plot DIR` has drawn before.\n"
      "comparison.html shows the curves of several runs in common figures, the keys in which their "
      "cases differ, and their sub-impacts matched with those of the first.\n"
      "sweep.html shows a map of the runs of a sweep, how their numbers are distributed, and a "
      "table.\n"
      "Needs Python 3.9 or later with the package subimpact; pages of sweeps and of several runs "
      "need Matplotlib too.\n"
      "Examples:\n"
      "  subimpact run case.toml --out out/first --error-bars all --set output.sections=0.5,0.4\n"
      "  subimpact plot out/first; subimpact report out/first\n"
      "  subimpact report out/first out/second --out out/both\n"
      "  subimpact report out/first --measured force.csv --low-pass 20kHz\n"
      "Exit status: 0 done; 2 bad command line, files that no run or instrument has written, or a "
      "page that cannot be written; 3 the comparison with a measurement cannot be written.");
}

}  // namespace subimpact::app
