#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "commands.h"
#include "progress.h"
#include "subimpact/case/doubtful_units.h"
#include "subimpact/io/report.h"
#include "subimpact/io/results.h"
#include "subimpact/study/compare.h"

namespace subimpact::app {
namespace {

struct CompareOptions {
  CaseOptions input;
  std::vector<std::string> methods;
  std::vector<std::string> theories;
  std::string directory;
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
};

int run_theories(const CompareOptions& options) {
  const auto with_theory = [&](const std::string& theory) {
    CaseOptions changed = options.input;
    changed.settings.push_back(fmt::format("beam.theory=\"{}\"", theory));
    return changed.load();
  };
  const LoadedCase loaded = with_theory(options.theories.front());
  std::vector<Case> cases;
  for (const std::string& theory : options.theories) cases.push_back(with_theory(theory).value);
  print_notes(loaded);
  print_warnings(doubtful_units(loaded.value));
  InterruptListener listener;
  StatusLine status;
  const auto runs = with_places(loaded, [&] {
    return compare_theories(
        cases, options.jobs, [&](std::size_t i) { status.show("running " + options.theories[i]); },
        [&](double) { return !listener.interrupted(); });
  });
  status.clear();
  if (!runs.empty()) {
    print("{}\n\n{}", loaded.value.title.empty() ? "untitled case" : loaded.value.title,
          theory_table(runs));
  }
  if (listener.interrupted()) {
    print_error("subimpact: interrupted; the theories above are those that had ended\n");
    return listener.exit_status();
  }
  for (const TheoryRun& run : runs) {
    if (!run.result.outcome.completed()) return failed;
  }
  return done;
}

int run_comparison(const CompareOptions& options) {
  if (!options.theories.empty()) return run_theories(options);
  if (options.methods.empty()) {
    throw CaseFileError("compare needs --methods or --theories, with names separated by commas");
  }
  const LoadedCase loaded = options.input.load();
  check_method_names(options.methods);
  print_notes(loaded);
  print_warnings(doubtful_units(loaded.value));
  std::optional<OutputDirectory> directory;
  if (!options.directory.empty()) directory.emplace(options.directory, "compare");
  InterruptListener listener;
  StatusLine status;
  const Comparison comparison = with_places(loaded, [&] {
    return compare(
        loaded.value, options.methods,
        [&](const std::string& name) { status.show("running " + name); },
        [&](double) { return !listener.interrupted(); });
  });
  status.clear();
  if (comparison.runs.empty()) {
    print_error("subimpact: interrupted before a method was compared; nothing is written\n");
    return listener.exit_status();
  }
  listener.hold_back();
  print("{}\n\n{}", loaded.value.title.empty() ? "untitled case" : loaded.value.title,
        comparison_table(comparison));
  if (directory) {
    if (!write_after_printing(*directory, [&](const std::filesystem::path& place) {
          write_comparison(place, comparison);
        })) {
      return failed;
    }
    print("\ncomparison.csv and matches.csv in {}\n", options.directory);
  }
  if (comparison.interrupted) {
    print_error("subimpact: interrupted; the methods above are those that had ended\n");
    return listener.exit_status();
  }
  for (const ComparedRun& run : comparison.runs) {
    if (!run.result.outcome.completed()) return failed;
  }
  return done;
}

}  // namespace

void add_compare(CLI::App& program, int& status) {
  CLI::App* command = program.add_subcommand(
      "compare", "Run one scene by several methods, or by several beam theories");
  auto options = std::make_shared<CompareOptions>();
  options->input.add_to(*command);
  command
      ->add_option("--methods", options->methods,
                   "Methods to compare, separated by commas; a method's table after a colon, "
                   "its solver.events after a plus sign")
      ->delimiter(',');
  command
      ->add_option("--theories", options->theories,
                   "Beam theories to compare instead, separated by commas: event times of each, "
                   "with their errors, and how much later they come than by the first")
      ->delimiter(',')
      ->excludes("--methods");
  add_directory_option(*command, options->directory,
                       "Directory for comparison.csv and matches.csv; made if missing. Without it "
                       "nothing is written")
      ->excludes("--theories");
  command->get_option("--method")->excludes("--methods");
  command->footer(
      "Every method runs at the case's solver.rtol, fixed-step methods at their default step or "
      "solver.step. They are compared with nystrom at rtol 1e-11, whose own error is stated; "
      "sub-impacts are matched one to one.\n"
      "Examples:\n"
      "  subimpact compare case.toml --methods central-difference,erk,dirk,imex,adams,bdf\n"
      "  subimpact compare case.toml --methods erk:dop853,erk:dormand-prince --out out/tables\n"
      "  subimpact compare case.toml --theories euler-bernoulli,rayleigh,timoshenko\n"
      "  subimpact compare case.toml --methods erk,erk+library,erk+interpolated\n"
      "  subimpact compare case.toml --methods exponential,erk --set model.section=elastic\n"
      "Exit status: 0 done; 2 bad command line or case file; 3 a method's solver failed; "
      "128 and the signal's number: stopped (130 by Ctrl-C), with the methods that had ended.");
  command->callback([options, &status] { status = run_comparison(*options); });
}

}  // namespace subimpact::app
