#include "commands.h"
#include "io/directory/listed_files.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/report/text.h"

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

int run_cases(const WorkPrecisionCommand& command, const std::vector<LabelledCase>& cases) {
  StudySession session;
  OutputDirectory directory(command.directory, "work-precision", case_id(cases.front().input));
  std::vector<WorkPrecision> studies;
  for (const auto& [label, input] : cases) {
    studies.emplace_back();
    WorkPrecisionOptions options;
    options.methods = command.methods;
    options.point_seconds = command.point_seconds;
    options.finished = [&](const WorkPrecision& so_far) {
      studies.back() = so_far;
      studies.back().label = label;
      write_file(directory.staging() / "work_precision.csv", work_precision_csv(studies));
      directory.commit();
    };
    options.announce = [&](const std::string& what) {
      session.status.show(fmt::format("{}: {}", label, what));
    };
    options.progress = session.progress();
    WorkPrecision study = work_precision(input, options);
    study.label = label;
    studies.back() = std::move(study);
    session.status.clear();
    print("{}: {}\n{}\n", title_of(input), label, work_precision_table(studies.back()));
    print("cheapest setting whose event times are all within\n{}\n",
          recommendation_text(recommendations_from(studies.back().points)));
    std::fflush(stdout);
    if (studies.back().interrupted) return session.end_interrupted("; finished points are kept");
  }
  print("work_precision.csv in {0}; subimpact plot {0} draws it\n", command.directory);
  return done;
}

int run_work_precision(WorkPrecisionCommand& command) {
  const LoadedCase loaded = command.input.load();
  print_doubts(loaded);
  if (command.directory.empty())
    command.directory = command.input.directory_with("-work-precision");
  return with_places(loaded, [&] {
    const std::vector<LabelledCase> cases = cases_of(loaded, command.sections);
    for (const LabelledCase& entry : cases) check_methods(entry.input, command.methods);
    note_swept(loaded);
    return run_cases(command, cases);
  });
}

std::vector<Option> options_of(WorkPrecisionCommand& options) {
  return options.input.of_case() +
         std::vector<Option>{
             {"--methods", &options.methods,
              "Methods to sweep, separated by commas; a method's table after a colon, its "
              "solver.events after a plus sign. Default: all that can run the case"},
             of_choices("--sections", options.sections, "model.section",
                        "Section laws, separated by commas, each in a panel of its own. Default: "
                        "the case's"),
             of_directory(options.directory,
                          "Directory for the CSV file; made if missing. Default: the case file's "
                          "name without its ending, and -work-precision, in the current directory"),
             of_seconds("--point-seconds", options.point_seconds,
                        "A setting that would take longer is reported as not run")};
}

}  // namespace

Command work_precision_command() {
  return command_with(
      "work-precision", "Compare cost and error of every method, and recommend settings",
      run_work_precision, options_of,
      "Each method is swept from coarse to fine, rtol in decades, fixed steps in halves, against "
      "a reference computed by two methods at rtol 1e-12. Runs end at the horizon, up to which the "
      "error of the reference is below 1e-4 us. Runs are timed one at a time: leave the machine "
      "otherwise idle. After Ctrl-C the finished points are kept.\n"
      "Examples:\n"
      "  subimpact work-precision case.toml --out out/chart; subimpact plot out/chart\n"
      "  subimpact work-precision case.toml --methods central-difference,erk:dop853,nystrom\n"
      "  subimpact work-precision case.toml --sections elastic,exact,layers --set time.end=2e-3\n"
      "Exit status: 0 done; 2 bad command line or case file; 3 results could not be written; 130 "
      "stopped by Ctrl-C.");
}

}  // namespace subimpact::app
