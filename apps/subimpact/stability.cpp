#include "commands.h"
#include "io/directory/listed_files.h"
#include "subimpact/report/text.h"

namespace subimpact::app {
namespace {

struct StabilityCommand : StudyOptions {
  double run_seconds = 20.0;
};

int run_stability(StabilityCommand& command) {
  const LoadedCase loaded = command.input.load();
  print_doubts(loaded);
  if (command.directory.empty()) command.directory = command.input.directory_with("-stability");
  return with_places(loaded, [&]() -> int {
    check_methods(loaded.value, command.methods);
    note_swept(loaded);
    OutputDirectory directory(command.directory, "stability", case_id(loaded.value));
    StudySession session;
    session.status.show("reference");
    const OutcomeMap map = outcome_map(loaded.value, command.methods, command.run_seconds,
                                       command.jobs, [&](std::size_t n, std::size_t all) {
                                         session.status.show(fmt::format("{} of {} runs", n, all));
                                         return !session.listener.interrupted();
                                       });
    session.status.clear();
    print("Outcomes of runs of the case\n\n{}\n", outcome_table(map));
    const auto write = [&](const auto& place) {
      write_file(place / "outcomes.csv", outcomes_csv(map));
    };
    if (!write_after_printing(directory, write)) return failed;
    print("outcomes.csv in {0}; subimpact plot {0} draws it\n", command.directory);
    return session.end(session.listener.interrupted(), done,
                       "; runs that had not ended are left out");
  });
}

std::vector<Option> options_of(StabilityCommand& options) {
  return options.input.of_case() +
         std::vector<Option>{
             {"--methods", &options.methods,
              "Only these methods, separated by commas; one without a table stands for all "
              "its tables. Default: all"},
             of_directory(options.directory,
                          "Directory for outcomes.csv; made if missing. Default: the case file's "
                          "name without its ending, and -stability, in the current directory"),
             of_seconds("--run-seconds", options.run_seconds, "Runs that take longer are left out"),
             of_jobs(options.jobs)};
}

}  // namespace

Command stability_command() {
  return command_with(
      "stability", "Find where each method fails, and how; as a table and CSV", run_stability,
      options_of,
      "Every method runs at fixed steps far below and beyond the stable ones, and at tolerances: "
      "right, wrong count, inaccurate, unstable, refused, failed. After Ctrl-C the runs that had "
      "ended remain.\n"
      "Examples:\n"
      "  subimpact stability case.toml --out out/stability; subimpact plot out/stability\n"
      "  subimpact stability case.toml --methods central-difference,exponential\n"
      "  subimpact stability case.toml --set time.end=2e-3\n"
      "Exit status: 0 done; 2 bad command line or case file; 3 results could not be written; 130 "
      "stopped by Ctrl-C.");
}

}  // namespace subimpact::app
