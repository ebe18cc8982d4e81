#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>

#include "commands.h"
#include "report/text/uncertain.h"
#include "subimpact/io/results.h"
#include "subimpact/report/text.h"
#include "subimpact/study/run_as_asked.h"

namespace subimpact::app {
namespace {

struct RunOptions {
  CaseOptions input;
  std::string directory;
  bool all = false;  // rows of the table
  std::string body_errors = "on";
  bool verbose = false;
  std::string error_bars;  // empty, "off" or "all"
  Jobs jobs = n_processors();
  bool quiet = false;
};

// The time that a run has reached, on the terminal, ten times per second.
class ProgressDisplay {
 public:
  ProgressDisplay(double end_time, bool quiet, const InterruptListener& listener)
      : listener_(listener), end_time_(end_time), quiet_(quiet) {}

  // What is running, shown before the time.
  void show_run(const std::string& description) {
    run_ = description + ": ";
    show(0.0);
  }

  // Returns false once the program was asked to end.
  bool operator()(double time) {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ >= std::chrono::milliseconds(100)) {
      last_ = now;
      show(time);
    }
    return !listener_.interrupted();
  }

 private:
  void show(double time) {
    if (quiet_) return;
    line_.write(fmt::format("{}{} of {} ({:.0f} %)", run_, duration_text(time),
                            duration_text(end_time_), 100.0 * time / end_time_));
  }

  const InterruptListener& listener_;
  double end_time_;
  bool quiet_;
  std::string run_;
  StatusLine line_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

std::optional<ErrorBars> error_bars_of(const LoadedCase& loaded, const RunOptions& options) {
  if (options.error_bars.empty()) return std::nullopt;
  if (loaded.value.accuracy.event_times) {
    throw CaseFileError(fmt::format(
        "--error-bars={}: cannot go with a tolerance on event times, whose errors come from other "
        "runs; leave out --error-bars, or --within and accuracy.event_times",
        options.error_bars));
  }
  return options.error_bars == "off" ? ErrorBars::off : ErrorBars::all;
}

WithinRun run_loaded(const LoadedCase& loaded, const RunOptions& options,
                     const InterruptListener& listener, ResultWriter& files) {
  ProgressDisplay progress(loaded.value.end_time, options.quiet, listener);
  RunRequest request;
  request.error_bars = error_bars_of(loaded, options);
  request.jobs = options.jobs;
  request.progress = std::ref(progress);
  request.announce = [&progress](const std::string& what) { progress.show_run(what); };
  request.rows = [&] {
    files.restart();
    return &files;
  };
  request.body_errors = options.body_errors == "on";
  return run_as_asked(loaded.value, loaded.given, std::move(request));
}

// As the shell takes it.
std::string quoted(const std::string& word) {
  constexpr const char* plain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=.,:/@%";
  if (!word.empty() && word.find_first_not_of(plain) == word.npos) return word;
  std::string text;
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return '\'' + text + '\'';
}

bool is_runnable(const CaseOptions& input, const std::vector<std::string>& more) {
  CaseOptions advised = input;
  advised.settings.insert(advised.settings.end(), more.begin(), more.end());
  try {
    const LoadedCase loaded = advised.load();
    resolve(first_run(loaded.value, loaded.given).input);
    return true;
  } catch (const Error&) {
    return false;
  }
}

// That of the run and a name: results-longer.
std::string directory_beside(const RunOptions& options, const std::string& name) {
  const std::filesystem::path given = std::filesystem::path(options.directory) / "";
  const std::string last = given.parent_path().filename().string();
  if (last.empty() || last.starts_with('.')) return options.input.directory_with("-" + name);
  return given.parent_path().string() + "-" + name;
}

// Commands that go on from here.
std::vector<NextStep> next_steps(const RunOptions& options, const GivenKeys& given,
                                 const WithinRun& run) {
  const std::string program = quoted(program_invocation_name);
  std::vector<NextStep> steps;
  if (run.input.parts.start) return steps;  // advice is for a first strike
  for (const Advice& advice : advice(run.input, given, run.result)) {
    std::vector<std::string> settings;
    std::string command = fmt::format("{} run {}", program, quoted(options.input.file));
    const auto append = [&](const std::string& option, const std::string& value) {
      command += fmt::format(" {} {}", option, quoted(value));
    };
    for (const auto& [option, value] :
         {std::pair("--method", options.input.method), std::pair("--within", options.input.within),
          std::pair("--opening", options.input.opening)}) {
      const auto is_it = [&](const auto& advised) { return advised.first == option; };
      if (!value.empty() && std::ranges::none_of(advice.options, is_it)) append(option, value);
    }
    for (const std::string& setting : options.input.settings) {
      const std::string key = setting.substr(0, setting.find('=') + 1);
      const auto replaces = [&](const auto& option) { return option.second.starts_with(key); };
      if (std::ranges::none_of(advice.options, replaces)) append("--set", setting);
    }
    for (const auto& [option, value] : advice.options) {
      append(option, value);
      if (option == "--set") settings.push_back(value);
    }
    append("--out", directory_beside(options, advice.name));
    if (!is_runnable(options.input, settings)) continue;
    const std::string seconds = with_digits(std::max(1.0, advice.seconds), 1);
    steps.push_back({command, fmt::format("{} (about {} s)", advice.gain, seconds)});
  }
  const auto scatters = [](const auto& of_key) { return of_key.second > 0.0; };
  if (std::ranges::any_of(run.input.scatter, scatters)) {
    std::string command = fmt::format("{} scatter {}", program, quoted(options.input.file));
    for (const std::string& setting : options.input.settings)
      command += " --set " + quoted(setting);
    steps.push_back(
        {command, "what the scatter of the case leaves of its times and forces (a minute)"});
  }
  return steps;
}

// The end of the summary.
std::string next_lines(std::vector<NextStep> steps, const std::string& directory) {
  if (!directory.empty()) {
    steps.insert(steps.begin(),
                 {fmt::format("{} report {}", quoted(program_invocation_name), quoted(directory)),
                  "draws it: the moving beam, charts, every number on one page (a few seconds)"});
  }
  std::string text;
  for (const auto& [command, gain] : steps) {
    text += fmt::format("  {:<19} {}\n{:24}{}\n", text.empty() ? "next" : "", command, "", gain);
  }
  return text;
}

int run(RunOptions& options) {
  LoadedCase loaded = options.input.load();
  error_bars_of(loaded, options);
  // Refuses what cannot be modelled before anything is written.
  with_places(loaded, [&] { check_memory(resolve(loaded.value).settings()); });
  ResultWriter files(
      options.directory.empty() ? options.input.directory_with("-results") : options.directory,
      loaded.value);
  const std::vector<std::string> doubts = print_doubts(loaded, options.quiet);
  InterruptListener listener;
  const WithinRun finished = with_places(loaded, [&] {
    WithinRun run = run_loaded(loaded, options, listener, files);
    run.result.next_steps = next_steps(options, loaded.given, run);
    make_answers(run.input, run.result);
    return run;
  });
  const Case& input = finished.input;
  listener.hold_back();
  const Result& result = finished.result;
  // Before anything is printed: the reader of a pipe may leave early and end the program.
  std::string unwritten;  // why
  try {
    files.finish(input, result, report_json(input, result));
  } catch (const OutputError& error) {
    unwritten = error.what();
  }
  const bool all_rows = options.all || !unwritten.empty();
  if (!options.quiet || !unwritten.empty()) {
    print("{}\n{}", run_summary(input, result, options.verbose),
          sub_impact_table(result, !all_rows));
    if (!result.strikes.empty()) print("\n{}", strike_table(result, all_rows));
    print("\n{}",
          next_lines(result.next_steps,
                     unwritten.empty() ? files.directory().path().string() : std::string()));
    if (unwritten.empty()) print("\nfiles in {}\n", files.directory().path().string());
    std::fflush(stdout);
  }
  std::vector<std::string> warnings = result.warnings;
  for (const std::string& doubt : doubts) std::erase(warnings, doubt);
  // The summary has them too.
  if (options.quiet || isatty(STDOUT_FILENO) == 0) print_warnings(warnings);
  if (!result.outcome.completed()) {
    print_error("subimpact: {}\n", failure_message(input, result));
  }
  if (!unwritten.empty()) {
    print_error("subimpact: {}\n", unwritten);
    return failed;
  }
  if (result.outcome.kind == OutcomeKind::stopped) return listener.exit_status();
  if (result.outcome.kind == OutcomeKind::left_validity) return refused;
  return result.outcome.completed() ? done : failed;
}

std::vector<Option> options_of(RunOptions& options) {
  options.input.may_repeat = true;
  Option error_bars = {
      "--error-bars", &options.error_bars,
      "By default all errors are estimated from runs on coarser meshes, which take up to "
      "one and a half times as long as the run itself; on a mesh that the case fixes, those of "
      "sub-impacts are of the integration in time. all: of that mesh too; off: no estimate"};
  error_bars.choices = {"all", "off"};
  return options.input.of_case_and_method() +
         std::vector<Option>{
             of_directory(
                 options.directory,
                 "Directory for events.csv, transitions.csv, history.csv, shapes.csv, "
                 "envelope.csv, "
                 "summary.json, report.json, manifest.json and, where asked for, sections.csv and "
                 "points.csv; made if missing. Default: the case file's name without its ending, "
                 "and -results, in the current directory"),
             options.input.of_within(),
             options.input.of_opening(),
             error_bars,
             {"--body-errors",
              &options.body_errors,
              "off: no estimate of how far the body itself may be from the model",
              {},
              {"on", "off"}},
             of_jobs(options.jobs),
             {"--quiet", &options.quiet, "Print nothing but warnings and errors"},
             {"--verbose", &options.verbose,
              "Print mesh, method, the runs beside, conservation and work too"},
             {"--all", &options.all,
              "Print every sub-impact, also those that are not certain one by one"}};
}

}  // namespace

Command run_command() {
  return command_with(
      "run", "Simulate a case", run, options_of,
      "Examples:\n"
      "  subimpact run case.toml\n"
      "  subimpact run case.toml --out out/tight --set solver.rtol=1e-10\n"
      "  subimpact run case.toml --within 1us\n"
      "  subimpact run case.toml --opening 1um\n"
      "  subimpact run case.toml --error-bars all\n"
      "  subimpact run case.toml --method central-difference --set solver.step=1e-7\n"
      "  subimpact run case.toml --set beam.ends=free,free --set 'title=\"Second try\"'\n"
      "Exit status: 0 done; 2 bad command line or case file, or a scene outside the model's "
      "validity; 3 a check or the solver failed, or results could not be written to DIR; 128 and "
      "the signal's number: stopped (130 by Ctrl-C). Once the run has begun, what was computed is "
      "written in every case: also after Ctrl-C, SIGTERM or SIGHUP; if DIR cannot be written any "
      "more (a full disk), every sub-impact is printed. Only kill -9 and a second Ctrl-C leave "
      "nothing new; DIR then holds the older results.");
}

}  // namespace subimpact::app
