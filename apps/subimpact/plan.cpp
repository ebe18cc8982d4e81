
#include "commands.h"
#include "subimpact/report/studies.h"

namespace subimpact::app {
namespace {

struct PlanCommand : StudyOptions {
  std::string error;
};

int run_plan(PlanCommand& command) {
  const LoadedCase loaded = command.input.load();
  print_doubts(loaded);
  std::optional<OutputDirectory> directory;
  if (!command.directory.empty()) directory.emplace(command.directory, "plan");
  StudySession session;
  const Plan result = with_places(loaded, [&] {
    ProgressDisplay progress(loaded.value.end_time, false, session.listener);
    PlanOptions how;
    how.jobs = command.jobs;
    how.announce = [&](const std::string& what, double end_time) {
      progress.show_run(what, end_time);
    };
    how.progress = std::ref(progress);
    return plan(loaded.value, *seconds_of(command.error), how);
  });
  if (result.interrupted && result.points.empty()) {
    return session.end_interrupted(" before a mesh was tried; nothing is written");
  }
  print("{}\n{}\n{}", title_of(loaded.value), plan_reference_table(result), plan_table(result));
  if (directory) {
    const auto write = [&](const std::filesystem::path& staging) { write_plan(staging, result); };
    if (!write_after_printing(*directory, write)) return failed;
    print("reference.csv, plan.csv, plan.svg and .png in {}\n", command.directory);
  }
  return session.end(result.interrupted, done,
                     "; the combinations above are those that were tried");
}

}  // namespace

void add_plan(CLI::App& program, int& status) {
  auto [command, options] =
      add_command(program, status, "plan",
                  "Find the cheapest mesh, method and setting for a wanted total error", run_plan);
  options.input.add_case_to(command);
  add_time_option(command, "--within,--error", options.error,
                  "Wanted bound on the error of every event time, from mesh, layers and time "
                  "together, with its unit: 1us")
      ->required();
  add_directory_option(command, options.directory,
                       "Directory for reference.csv, plan.csv and a chart; made if missing. "
                       "Without it nothing is written");
  add_jobs_option(command, options.jobs);
  command.footer(
      "The reference is the run that run --within chooses for a fifth of the wanted error. "
      "Sequences of meshes and methods are judged by it; a mesh is admitted only if all finer ones "
      "of its sequence are within the error too.\n"
      "Examples:\n"
      "  subimpact plan case.toml --within 1us\n"
      "  subimpact plan case.toml --within 0.05us --set model.section=elastic --out out/plan\n"
      "Exit status: 0 done; 2 bad command line or case file; 3 results could not "
      "be written; 128 and the signal's number: stopped "
      "(130 by Ctrl-C).");
}

}  // namespace subimpact::app
