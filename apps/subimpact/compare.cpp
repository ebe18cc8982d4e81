
#include <algorithm>

#include "commands.h"
#include "io/directory/listed_files.h"
#include "subimpact/report/text.h"
#include "subimpact/study/studies.h"

namespace subimpact::app {
namespace {

struct CompareOptions : StudyOptions {
  std::vector<std::string> theories;
  std::vector<std::string> laws;
};

int status_of(const auto& runs) {
  const bool all_completed =
      std::ranges::all_of(runs, [](const auto& run) { return run.result.outcome.completed(); });
  return all_completed ? done : failed;
}

std::string heading(const Case& input) {
  const double opening = input.output.opening;
  return title_of(input) +
         (opening > 0.0
              ? fmt::format("; contacts parted by less than {:.4g} um joined", 1e6 * opening)
              : "");
}

int run_models(const CompareOptions& options) {
  const bool of_laws = !options.laws.empty();
  const std::vector<std::string>& names = of_laws ? options.laws : options.theories;
  const auto with_theory = [&](const std::string& theory) {
    CaseOptions changed = options.input;
    changed.settings.push_back(fmt::format("beam.theory=\"{}\"", theory));
    return changed.load();
  };
  const LoadedCase loaded = of_laws ? options.input.load() : with_theory(names.front());
  std::vector<Case> cases;
  with_places(loaded, [&] {
    for (const std::string& name : names) {
      cases.push_back(of_laws ? with_contact_law(loaded.value, name) : with_theory(name).value);
    }
  });
  print_doubts(loaded);
  StudySession session;
  const auto runs = with_places(loaded, [&] {
    return compare_models(
        cases, names, options.jobs,
        [&](std::size_t i) { session.status.show("running " + names[i]); }, session.progress());
  });
  session.status.clear();
  if (!runs.empty()) print("{}\n\n{}", heading(loaded.value), model_table(runs));
  return session.end(session.listener.interrupted(), status_of(runs),
                     "; the models above are those that had ended");
}

int run_comparison(CompareOptions& options) {
  if (!options.theories.empty() || !options.laws.empty()) return run_models(options);
  if (options.methods.empty()) {
    throw CaseFileError(
        "compare needs --methods, --theories or --laws, with names separated by commas");
  }
  const LoadedCase loaded = options.input.load();
  check_methods(loaded.value, options.methods);
  print_doubts(loaded);
  std::optional<OutputDirectory> directory;
  if (!options.directory.empty()) directory.emplace(options.directory, "compare");
  StudySession session;
  const Comparison comparison = with_places(loaded, [&] {
    return compare(
        loaded.value, options.methods,
        [&](const std::string& name) { session.status.show("running " + name); },
        session.progress());
  });
  session.status.clear();
  if (comparison.runs.empty()) {
    return session.end_interrupted(" before a method was compared; nothing is written");
  }
  session.listener.hold_back();
  print("{}; all on {}\n\n{}", heading(loaded.value), comparison.reference.result.used.mesh,
        comparison_table(comparison));
  if (directory) {
    const auto write = [&](const auto& place) {
      write_file(place / "comparison.csv", comparison_csv(comparison));
      write_file(place / "matches.csv", matches_csv(comparison));
    };
    if (!write_after_printing(*directory, write)) return failed;
    print("\ncomparison.csv and matches.csv in {}\n", options.directory);
  }
  return session.end(comparison.interrupted, status_of(comparison.runs),
                     "; the methods above are those that had ended");
}

std::vector<Option> options_of(CompareOptions& options) {
  Option methods = {"--methods", &options.methods,
                    "Methods to compare, separated by commas; a method's table after a colon, "
                    "its solver.events after a plus sign"};
  methods.excludes = {"--method"};
  Option theories =
      of_choices("--theories", options.theories, "beam.theory",
                 "Beam theories to compare instead, separated by commas: event times of each, "
                 "with their errors, and how much later they come than by the first");
  theories.excludes = {"--methods"};
  Option laws = of_choices("--laws", options.laws, "contact.law",
                           "Contact laws to compare instead, separated by commas, each with the "
                           "constants that the case gives for it");
  laws.excludes = {"--methods", "--theories"};
  Option directory = of_directory(options.directory,
                                  "Directory for comparison.csv and matches.csv; made if missing. "
                                  "Without it nothing is written");
  directory.excludes = {"--theories", "--laws"};
  return options.input.of_case_and_method() +
         std::vector<Option>{options.input.of_opening(), methods, theories, laws, directory};
}

}  // namespace

Command compare_command() {
  return command_with(
      "compare", "Run one scene by several methods, beam theories or contact laws", run_comparison,
      options_of,
      "Every method runs at solver.step if it is given, else at solver.rtol or its default step. "
      "The reference is nystrom at rtol 1e-11, or erk for a damped strike; its error is stated "
      "from "
      "a run by another method. Sub-impacts are matched one to one.\n"
      "Examples:\n"
      "  subimpact compare case.toml --methods central-difference,erk,dirk,adams,bdf\n"
      "  subimpact compare case.toml --methods erk:dop853,erk:dormand-prince --out out/tables\n"
      "  subimpact compare case.toml --theories euler-bernoulli,rayleigh,timoshenko\n"
      "  subimpact compare case.toml --laws foundation,hertz,sphere\n"
      "  subimpact compare case.toml --methods erk,erk+library,erk+interpolated\n"
      "  subimpact compare case.toml --methods exponential,erk --set model.section=elastic\n"
      "Exit status: 0 done; 2 bad command line or case file; 3 a method's solver failed; "
      "128 and the signal's number: stopped (130 by Ctrl-C), with the methods that had ended.");
}

}  // namespace subimpact::app
