
#include <algorithm>

#include "commands.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/report/studies.h"
#include "subimpact/report/text.h"
#include "subimpact/study/run_as_asked.h"

namespace subimpact::app {
namespace {

struct SensitivityCommand : StudyOptions {
  std::vector<std::string> keys;
  bool quiet = false;
};

void check_keys(const std::vector<std::string>& names) try {
  for (const std::string& name : names) known_key(name);
} catch (const InvalidCase& error) {
  throw CaseFileError(fmt::format("--by {} {}", error.key, error.what()));
}

int run_sensitivity(SensitivityCommand& command) {
  const LoadedCase loaded = command.input.load();
  check_keys(command.keys);
  std::optional<OutputDirectory> directory;
  if (!command.directory.empty()) directory.emplace(command.directory, "sensitivity");
  print_doubts(loaded, command.quiet);
  StudySession session;
  const auto show = [&](const std::string& text) {
    if (!command.quiet) session.status.show(text);
  };
  const Sensitivity study = with_places(loaded, [&] {
    show("choosing the mesh");
    SensitivityOptions options;
    options.keys = command.keys;
    options.jobs = command.jobs;
    options.progress = session.progress();
    options.finished = [&](std::size_t n_done, std::size_t n_all) {
      if (!command.quiet) session.status.show_runs("", n_done, n_all);
    };
    const Case input = case_as_chosen(loaded.value, loaded.given, options.jobs, options.progress);
    show("base run");
    return sensitivity(input, options);
  });
  session.status.clear();
  session.listener.hold_back();
  if (const ExitStatus base = status_of(study.base.outcome.kind); base != done) {
    print_error("subimpact: {}\n", failure_message(study.input, study.base));
    return base;
  }
  if (study.keys.empty() && study.interrupted) {
    return session.end_interrupted(" before the runs of a key had ended; nothing is written");
  }
  const bool only_first_touch =
      std::ranges::all_of(study.rows, [](const SensitivityRow& row) { return row.value == 0.0; });
  if (!study.interrupted && only_first_touch) {
    print_warnings(
        {"no number of a sub-impact can be derived before time.end: the first contact "
         "lasts to the end; use a later time.end"});
  }
  if (!command.quiet) print("{}\n\n{}", title_of(loaded.value), sensitivity_table(study));
  if (directory) {
    const auto write = [&](const auto& place) { write_sensitivity(place, study); };
    if (!write_after_printing(*directory, write)) return failed;
    if (!command.quiet) print("\nsensitivity.csv in {}\n", command.directory);
  }
  return session.end(study.interrupted, study.keys.empty() ? failed : done,
                     "; the keys above are those whose runs had ended");
}

}  // namespace

void add_sensitivity(CLI::App& program, int& status) {
  auto [command, options] =
      add_command(program, status, "sensitivity",
                  "Show how event times, forces and velocities depend on the numbers of a case",
                  run_sensitivity);
  options.input.add_to(command);
  add_list_option(command, "--by", options.keys,
                  "Keys to derive by, separated by commas. Default: all numbers of beam, striker "
                  "and contact that take effect");
  add_directory_option(
      command, options.directory,
      "Directory for sensitivity.csv: derivatives, by the logarithm of each key, of start, end, "
      "peak force, impulse, indentation and striker velocity of every sub-impact, with their "
      "errors; made if missing. Without it nothing is written");
  add_jobs_option(command, options.jobs);
  command.add_flag("--quiet", options.quiet, "Print nothing but warnings and errors");
  command.footer(
      "Each key takes four runs, two shifts to either side, at rtol 1e-13 on the mesh of the case; "
      "their differences give the derivative, the mismatch of the shifts its error. Rows of "
      "contacts that are about to merge, to split or to vanish are flagged.\n"
      "Examples:\n"
      "  subimpact sensitivity case.toml\n"
      "  subimpact sensitivity case.toml --by striker.velocity,beam.thickness --out out/by-two\n"
      "  subimpact sensitivity case.toml --method nystrom --set time.end=2e-3\n"
      "Exit status: 0 done; 2 bad command line or case file, or a key without a derivative; 3 a "
      "run failed; 128 and the signal's number: stopped (130 by Ctrl-C), with the keys whose runs "
      "had ended.");
}

}  // namespace subimpact::app
