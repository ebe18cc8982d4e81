#include <fmt/format.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "commands.h"
#include "interrupt.h"
#include "jobs_option.h"
#include "print.h"
#include "progress.h"
#include "subimpact/io/plan.h"
#include "subimpact/io/results.h"
#include "subimpact/report/studies.h"
#include "time_option.h"

namespace subimpact::app {
namespace {

struct PlanCommand {
  CaseOptions input;
  std::string error;
  std::string directory;
  JobsOption jobs;
};

int run_plan(const PlanCommand& command) {
  const LoadedCase loaded = command.input.load();
  std::optional<OutputDirectory> directory;
  if (!command.directory.empty()) directory.emplace(command.directory, "plan");
  InterruptListener listener;
  const Plan result = with_places(loaded, [&] {
    ProgressDisplay progress(loaded.value.end_time, false, listener);
    PlanOptions how;
    how.jobs = command.jobs.number();
    how.announce = [&](const std::string& what, double end_time) {
      progress.show_run(what, end_time);
    };
    how.progress = std::ref(progress);
    return plan(loaded.value, *seconds_of(command.error), how);
  });
  if (result.interrupted && result.points.empty()) {
    print_error("subimpact: interrupted before a mesh was tried; nothing is written\n");
    return listener.exit_status();
  }
  print("{}\n{}\n{}", loaded.value.title.empty() ? "untitled case" : loaded.value.title,
        plan_reference_table(result), plan_table(result));
  if (directory) {
    write_plan(directory->staging(), result);
    draw_plan(directory->staging(), result);
    directory->commit();
    print_warnings(directory->notes());
    print("reference.csv, plan.csv, plan.svg and .png in {}\n", command.directory);
  }
  if (!result.interrupted) return done;
  print_error("subimpact: interrupted; the combinations above are those that were tried\n");
  return listener.exit_status();
}

}  // namespace

void add_plan(CLI::App& program, int& status) {
  CLI::App* command = program.add_subcommand(
      "plan", "Find the cheapest mesh, method and setting for a wanted total error");
  auto options = std::make_shared<PlanCommand>();
  options->input.add_case_to(*command);
  add_time_option(*command, "--within,--error", options->error,
                  "Wanted bound on the error of every event time, from mesh, layers and time "
                  "together, with its unit: 1us")
      ->required();
  add_directory_option(*command, options->directory,
                       "Directory for reference.csv, plan.csv and a chart; made if missing. "
                       "Without it nothing is written");
  options->jobs.add_to(*command);
  command->footer(
      "The reference is the run that run --within chooses for a fifth of the wanted error. "
      "Sequences of meshes and methods are judged by it; a mesh is admitted only if all finer ones "
      "of its sequence are within the error too.\n"
      "Examples:\n"
      "  subimpact plan case.toml --within 1us\n"
      "  subimpact plan case.toml --within 0.05us --set model.section=elastic --out out/plan\n"
      "Exit status: 0 done; 2 bad command line or case file; 128 and the signal's number: stopped "
      "(130 by Ctrl-C).");
  command->callback([options, &status] { status = run_plan(*options); });
}

}  // namespace subimpact::app
