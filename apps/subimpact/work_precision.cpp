#include <fmt/ranges.h>

#include "case/counted.h"
#include "commands.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/report/studies.h"

namespace subimpact::app {
namespace {

struct WorkPrecisionCommand : StudyOptions {
  std::vector<std::string> sections;
  double point_seconds = 10.0;
};

struct LabelledCase {
  std::string label;
  Case input;
};

std::vector<LabelledCase> cases_of(const LoadedCase& loaded,
                                   const std::vector<std::string>& sections) {
  const CaseKey& key = *find_case_key("model.section");
  std::vector<LabelledCase> cases;
  for (const std::string& section : sections) {
    Case input = loaded.value;
    assign(input, key, section);
    cases.push_back({section, input});
  }
  if (cases.empty()) {
    cases.push_back({std::get<std::string>(*key.get(loaded.value)), loaded.value});
  }
  for (LabelledCase& entry : cases) {
    if (entry.input.model.section == SectionKind::layers) {
      entry.label = fmt::format("{} layers", entry.input.model.layers);
    } else {
      entry.label += " section";
    }
  }
  return cases;
}

WorkPrecision study(const WorkPrecisionCommand& command, const LabelledCase& entry, PointLog& log,
                    StudySession& session) {
  const std::string id = case_id(entry.input);
  WorkPrecisionOptions options;
  options.methods = command.methods;
  options.point_seconds = command.point_seconds;
  options.known = [&](const Setting& setting) { return log.known(id, setting); };
  options.finished = [&](const Trial& point) { log.append(id, entry.label, point); };
  options.announce = [&](const std::string& what) {
    session.status.show(entry.label + ": " + what);
  };
  options.progress = session.progress();
  WorkPrecision result = work_precision(entry.input, options);
  result.label = entry.label;
  return result;
}

int run_cases(const WorkPrecisionCommand& command, const std::vector<LabelledCase>& cases) {
  std::vector<std::string> ids;
  for (const LabelledCase& entry : cases) ids.push_back(case_id(entry.input));
  StudySession session;
  OutputDirectory directory(command.directory, "work-precision",
                            fmt::to_string(fmt::join(ids, "-")));
  PointLog log(directory, ids);
  if (log.n_known() > 0) {
    print("{} of an earlier study in {} {} kept\n\n", counted(log.n_known(), "point"),
          command.directory, log.n_known() == 1 ? "is" : "are");
  }
  std::vector<WorkPrecision> studies;
  for (const LabelledCase& entry : cases) {
    studies.push_back(study(command, entry, log, session));
    session.status.clear();
    print("{}: {}\n{}\n", title_of(entry.input), entry.label, work_precision_table(studies.back()));
    print("cheapest setting whose event times are all within\n{}\n",
          recommendation_text(recommendations_from(studies.back().points)));
    std::fflush(stdout);
    if (studies.back().interrupted) break;
  }
  print("work_precision.csv in {0}; subimpact plot {0} draws it\n", command.directory);
  if (!studies.back().interrupted) return done;
  return session.end_interrupted(
      "; finished points are kept, and the same command continues from there");
}

int run_work_precision(WorkPrecisionCommand& command) {
  const LoadedCase loaded = command.input.load();
  print_doubts(loaded);
  if (command.directory.empty())
    command.directory = command.input.directory_with("-work-precision");
  return with_places(loaded, [&] {
    const std::vector<LabelledCase> cases = cases_of(loaded, command.sections);
    for (const LabelledCase& entry : cases) check_methods(entry.input, command.methods);
    return run_cases(command, cases);
  });
}

}  // namespace

void add_work_precision(CLI::App& program, int& status) {
  auto [command, options] = add_command(
      program, status, "work-precision",
      "Compare cost and error of every method, and recommend settings", run_work_precision);
  options.input.add_case_to(command);
  add_list_option(command, "--methods", options.methods,
                  "Methods to sweep, separated by commas; a method's table after a colon, its "
                  "solver.events after a plus sign. Default: all that can run the case");
  add_choices_option(command, "--sections", options.sections, "model.section",
                     "Section laws, separated by commas, each in a panel of its own. Default: the "
                     "case's");
  add_directory_option(command, options.directory,
                       "Directory for the CSV file; made if missing. Default: the case file's "
                       "name without its ending, and -work-precision, in the current directory");
  add_seconds_option(command, "--point-seconds", options.point_seconds,
                     "A setting that would take longer is reported as not run");
  command.footer(
      "Each method is swept from coarse to fine, rtol in decades or fixed steps in halves, against "
      "a reference computed by two methods at rtol 1e-12. Runs end at the horizon, up to which the "
      "error of the reference is below 1e-4 us. Runs are timed one at a time: leave the machine "
      "otherwise idle. After Ctrl-C the finished points are kept; the same command with "
      "the same --out continues.\n"
      "Examples:\n"
      "  subimpact work-precision case.toml --out out/chart; subimpact plot out/chart\n"
      "  subimpact work-precision case.toml --methods central-difference,erk:dop853,nystrom\n"
      "  subimpact work-precision case.toml --sections elastic,exact,layers --set time.end=2e-3\n"
      "Exit status: 0 done; 2 bad command line or case file; 3 results could not be written; 130 "
      "stopped by Ctrl-C.");
}

}  // namespace subimpact::app
