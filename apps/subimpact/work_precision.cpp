#include "subimpact/io/work_precision.h"
#include "print.h"
#include "subimpact/report/studies.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <memory>

#include "case/counted.h"
#include "commands.h"
#include "interrupt.h"
#include "status_line.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/results.h"

namespace subimpact::app {
namespace {

struct WorkPrecisionCommand {
  CaseOptions input;
  std::vector<std::string> methods;
  std::vector<std::string> sections;
  std::string directory;
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

class Session {
 public:
  Session(const WorkPrecisionCommand& command, const std::vector<LabelledCase>& cases)
      : command_(command),
        cases_(cases),
        directory_(command.directory, "work-precision", fmt::to_string(fmt::join(ids(cases), "-"))),
        log_(directory_, ids(cases)) {
    if (log_.n_known() > 0) {
      print("{} of an earlier study in {} {} kept\n\n", counted(log_.n_known(), "point"),
            command.directory, log_.n_known() == 1 ? "is" : "are");
    }
  }

  int run() {
    std::vector<WorkPrecision> studies;
    for (const LabelledCase& entry : cases_) {
      studies.push_back(study(entry));
      status_.clear();
      print("{}: {}\n{}\n", entry.input.title.empty() ? "untitled case" : entry.input.title,
            entry.label, work_precision_table(studies.back()));
      print("cheapest setting whose event times are all within\n{}\n",
            recommendation_text(recommendations_from(studies.back().points)));
      std::fflush(stdout);
      if (studies.back().interrupted) break;
    }
    draw_work_precision(directory_.staging(), studies);
    directory_.commit();
    print_warnings(directory_.notes());
    print(
        "work_precision.csv, work_precision.svg and .png, work_precision_evaluations.svg "
        "and .png in {}\n",
        command_.directory);
    if (!studies.back().interrupted) return done;
    print_error(
        "subimpact: interrupted; finished points are kept, and the same command "
        "continues from there\n");
    return listener_.exit_status();
  }

 private:
  static std::vector<std::string> ids(const std::vector<LabelledCase>& cases) {
    std::vector<std::string> list;
    for (const LabelledCase& entry : cases) list.push_back(case_id(entry.input));
    return list;
  }

  WorkPrecision study(const LabelledCase& entry) {
    const std::string id = case_id(entry.input);
    WorkPrecisionOptions options;
    options.methods = command_.methods;
    options.point_seconds = command_.point_seconds;
    options.known = [&](const Setting& setting) { return log_.known(id, setting); };
    options.finished = [&](const WorkPrecisionPoint& point) {
      log_.append(id, entry.label, point);
    };
    options.announce = [&](const std::string& what) { status_.show(entry.label + ": " + what); };
    options.progress = [&](double) { return !listener_.interrupted(); };
    WorkPrecision result = work_precision(entry.input, options);
    result.label = entry.label;
    return result;
  }

  const WorkPrecisionCommand& command_;
  const std::vector<LabelledCase>& cases_;
  OutputDirectory directory_;
  PointLog log_;
  InterruptListener listener_;
  StatusLine status_;
};

int run_work_precision(WorkPrecisionCommand command) {
  const LoadedCase loaded = command.input.load();
  if (command.directory.empty())
    command.directory = command.input.directory_with("-work-precision");
  return with_places(loaded, [&] {
    const std::vector<LabelledCase> cases = cases_of(loaded, command.sections);
    for (const LabelledCase& entry : cases) check_methods(entry.input, command.methods);
    return Session(command, cases).run();
  });
}

}  // namespace

void add_work_precision(CLI::App& program, int& status) {
  CLI::App* command = program.add_subcommand(
      "work-precision", "Chart cost against error for every method, and recommend settings");
  auto options = std::make_shared<WorkPrecisionCommand>();
  options->input.add_case_to(*command);
  command
      ->add_option("--methods", options->methods,
                   "Methods to sweep, separated by commas; a method's table after a colon, "
                   "its solver.events after a plus sign. "
                   "Default: all that can run the case")
      ->delimiter(',');
  command
      ->add_option("--sections", options->sections,
                   "Section laws, separated by commas, each in a panel of its own. Default: the "
                   "case's")
      ->delimiter(',');
  add_directory_option(*command, options->directory,
                       "Directory for CSV and figures; made if missing. Default: the case file's "
                       "name without its ending, and -work-precision, in the current directory");
  command
      ->add_option("--point-seconds", options->point_seconds,
                   "A setting that would take longer is reported as not run")
      ->check(positive_seconds)
      ->capture_default_str();
  command->footer(
      "Each method is swept from coarse to fine, rtol in decades or fixed steps in halves, against "
      "a reference computed by two methods at rtol 1e-12. Runs end at the horizon, up to which the "
      "error of the reference is below 1e-4 us. Runs are timed one at a time: leave the machine "
      "otherwise idle. After Ctrl-C the finished points are charted; the same command with "
      "the same --out continues.\n"
      "Examples:\n"
      "  subimpact work-precision case.toml --out out/chart\n"
      "  subimpact work-precision case.toml --methods central-difference,erk:dop853,nystrom\n"
      "  subimpact work-precision case.toml --sections elastic,exact,layers --set time.end=2e-3\n"
      "Exit status: 0 done; 2 bad command line or case file; 3 a figure could not be drawn; 130 "
      "stopped by Ctrl-C.");
  command->callback([options, &status] { status = run_work_precision(*options); });
}

}  // namespace subimpact::app
