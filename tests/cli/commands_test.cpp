#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "io/records/run_tables.h"
#include "process.h"
#include "run_files.h"
#include "subimpact/io/case_file.h"
#include "subimpact/io/results.h"
#include "subimpact/study/run_as_asked.h"
#include "unwrapped.h"

namespace subimpact {
namespace {

using ARun = InADirectory;
using ScatterCommand = InADirectory;
using SensitivityCommand = InADirectory;

TEST(Help, OfEveryCommandGivesAnExampleOfThatCommand) {
  for (const std::string command : {"run", "work-precision", "stability", "sensitivity", "scatter",
                                    "plot", "report", "explain", "methods", "keys", "columns"}) {
    expect_in(run_anywhere({command, "--help"}).output, "Example", "\n  subimpact " + command);
  }
}

TEST(Listings, NameWhatThereIs) {
  expect_in(run_anywhere({"--help"}).output, "run", "work-precision", "stability", "sensitivity",
            "plot", "report", "explain", "methods", "keys", "columns", "Examples:", "Exit status");
  expect_in(run_anywhere({"--version"}).output, "subimpact ", "SUNDIALS ", "KLU ", "toml++ ");
  expect_in(run_anywhere({"methods"}).output, "central-difference ", "erk ", "dop853 ", "8(5)");
  expect_in(run_anywhere({"columns"}).output, "events.csv: one row per sub-impact\n",
            "history.csv: ", "\n  w_c_m ", "sections.csv: ", "points.csv: ", "shapes.csv: ",
            "envelope.csv: ", "\n  max_moment_Nm ");
  expect_in(run_anywhere({"keys"}).output, "[beam]\n", "youngs_modulus ", "[output]\n",
            "zone_gap ");
  expect_in(run_anywhere({"keys", "--schema"}).output, "json-schema.org/draft/2020-12",
            "\"youngs_modulus\"", "\"hermite\"");
}

TEST(WorkPrecision, WritesWhatItRanAndAdvises) {
  const TemporaryDirectory directory;
  const Words command = paper(
      "work-precision", {"time.end=3e-4"},
      {"--methods", "central-difference,exponential", "--sections", "elastic", "--out", "chart"});
  expect_in(run_in(directory, command).output, "reference: nystrom at rtol 1e-12 and erk",
            "horizon: 286.242 us", "central-difference", "cheapest setting", "0.001 us");
  EXPECT_TRUE(directory.has("chart/work_precision.csv"));
}

TEST(MethodsOption, IsBlamedForAMethodThatDoesNotExist) {
  const TemporaryDirectory directory;
  directory.write("case.toml", read_file(SUBIMPACT_PAPER_CASE));
  for (const char* command : {"compare", "work-precision", "stability"}) {
    const Finished finished = run_in(directory, {command, "case.toml", "--methods", "erk,erkk"}, 2);
    EXPECT_EQ(finished.errors.find("--methods erkk: solver.method is \"erkk\"; allowed: "), 0u)
        << finished.errors;
    expect_in(finished.errors, "\"central-difference\", \"erk\"", "did you mean \"erk\"?");
    expect_not_in(finished.errors, "case.toml");
  }
}

TEST(Stability, WritesTheOutcomesOfTheMethodsAskedFor) {
  const TemporaryDirectory directory;
  expect_in(run_in(directory, paper("stability", {"model.segments=101", "time.end=3e-4"},
                                    {"--methods", "central-difference", "--out", "s"}))
                .output,
            "central-difference, forced", "omega_max h");
  EXPECT_TRUE(directory.has("s/outcomes.csv"));
}

TEST(Explain, TellsWhatWillBeModelledAndWritesNothing) {
  const TemporaryDirectory directory;
  const Finished finished = run_in(directory, {"explain", SUBIMPACT_PAPER_CASE});
  EXPECT_EQ(finished.errors, "");
  expect_in(finished.output, "critical_step_s", "position_tolerance_m", "251",
            "yield_indentation_m", "time");
  EXPECT_TRUE(std::filesystem::is_empty(directory.path));
}

TEST(ARunAsAsked, GivesWhatTheProgramGivesNumberForNumber) {
  const TemporaryDirectory directory;
  run_in(directory, paper("run", {"time.end=3e-4"}, {"--out", "here", "--quiet"}));
  const auto program = summary_in(directory.path / "here");
  const LoadedCase loaded = read_case_file(SUBIMPACT_PAPER_CASE, {parse_override("time.end=3e-4")});
  const WithinRun here = run_as_asked(loaded.value, loaded.given);
  EXPECT_EQ(here.result.used.mesh, program.at("used").at("mesh").get<std::string>());
  EXPECT_EQ(csv_of<SubImpact>(here.result), directory.read("here/events.csv"));
  EXPECT_EQ(here.result.striker_velocity, program.at("final").at("striker_velocity_m_per_s"));
}

Words of_paper(const std::string& command, Words more) {
  more.insert(more.end(), {"--method", "exponential"});
  return paper(command, {"model.section=elastic", "time.end=3e-4"}, more);
}

TEST_F(SensitivityCommand, WritesItsFileAndPrintsTheTable) {
  expect_in(run_in(directory, of_paper("sensitivity",
                                       {"--by", "striker.velocity,beam.thickness", "--out", "s"}))
                .output,
            "us per 1 %", "striker.", "velocity", "218.94", "sensitivity.csv in s",
            "at rtol 1e-13 in place of 1e-08");
  expect_in(directory.read("s/sensitivity.csv"), "d_striker.velocity,error_striker.velocity,",
            "\nstart_s,1,0,0,0,0,0,\nend_s,1,0.00021894");
}

TEST_F(ScatterCommand, WritesItsFilesAndPrintsHowFarTheStrikeCanBePredicted) {
  expect_in(run_in(directory,
                   of_paper("scatter", {"--set", "scatter.striker.velocity=0.01", "--out", "s"}))
                .output,
            "predictable: ", "times with their standard deviations", "zone 1",
            "force: 9230 +- 70 N", "64 runs");
  const auto summary = nlohmann::json::parse(directory.read("s/scatter.json"));
  // The first contact ends 1.654 us later for each unit of ln v.
  const double scatter = table_in(directory.path / "s/scatter.csv").at(0).number("end_scatter_s");
  EXPECT_NEAR(scatter, 0.01 * 1.654e-6, 0.01 * 1e-9);
  EXPECT_NEAR(summary.at("zones").at(0).at("start_scatter_s"), 0.0, 1e-15);
}

TEST_F(ScatterCommand, RefusesACaseInWhichNothingScattersAndRunNamesItForOthers) {
  expect_in(run_in(directory, of_paper("scatter", {}), 2).errors, "nothing scatters");
  expect_in(run_in(directory, of_paper("run", {"--set", "scatter.striker.velocity=0.01"})).output,
            " scatter ", "--set scatter.striker.velocity=0.01");
}

TEST_F(ARun, AdvisesCommandsThatTheShellTakes) {
  directory.write("it's a case.toml", read_file(SUBIMPACT_PAPER_CASE));
  const Finished finished =
      run_program({"run", "it's a case.toml", "--set", "time.end=3e-4", "--set", "title=A strike"},
                  directory.path);
  expect_in(unwrapped(finished.output), " report ", "beam.theory=timoshenko",
            "model.segments=default");
  std::istringstream lines(finished.output.substr(finished.output.find("  next ")));
  int n_commands = 0;
  for (std::string line; std::getline(lines, line) && !line.empty();) {
    const auto begin = line.find(SUBIMPACT_PROGRAM);
    if (begin == line.npos) continue;
    ++n_commands;
    const bool is_run = line.find(" run ") != line.npos;
    const std::string command =
        fmt::format("cd {} && {}{} > printed 2>&1", directory.path.string(), line.substr(begin),
                    is_run ? " --set time.end=3e-5" : "");
    EXPECT_EQ(std::system(command.c_str()), 0) << command << "\n" << directory.read("printed");
  }
  EXPECT_GE(n_commands, 3) << finished.output;
  EXPECT_TRUE(directory.has("it's a case-longer/summary.json"));  // in directories of their own
  const auto next =
      nlohmann::json::parse(directory.read("it's a case-results/summary.json"))["next"];
  EXPECT_EQ(static_cast<int>(next.size()), n_commands - 1);  // that of the page is not among them
  for (const auto& step : next) {
    expect_in(step["command"].get<std::string>(), " run ", " --out ");
    expect_in(step["gain"].get<std::string>(), " (about ");
  }
}

TEST(Advice, KeepsTheOptionsOfTheRunAndWritesBesideItsDirectory) {
  const TemporaryDirectory directory;
  directory.write("case.toml", read_file(SUBIMPACT_PAPER_CASE));
  const Finished finished = run_in(directory, {"run", "case.toml", "--set", "time.end=3e-4",
                                               "--out", "res/", "--opening", "2um"});
  expect_in(unwrapped(finished.output),
            "run case.toml --opening 2um --set time.end=0.0006 --out res-longer");
}

TEST(ThePython, OfTheProgramFindsItsPackageAndTakesAllArguments) {
  const char* look = "import importlib.util as u; print(u.find_spec('subimpact').origin)";
  expect_in(run_anywhere({"python", "-c", look}, 0).output, "python/subimpact/__init__.py");
  run_anywhere({"python", "-c", "import sys; sys.exit(len(sys.argv))", "--help", "-x"}, 3);
  const TemporaryDirectory directory;
  EXPECT_EQ(shell("SUBIMPACT_PYTHON_EXECUTABLE=/nowhere/python3 subimpact python 2> errors",
                  directory.path),
            2);
  expect_in(directory.read("errors"), "/nowhere/python3: cannot be run");
}

}  // namespace
}  // namespace subimpact
