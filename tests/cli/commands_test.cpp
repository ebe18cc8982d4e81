#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "process.h"

namespace subimpact {
namespace {

void expect_in(const std::string& text, const std::string& piece) {
  EXPECT_NE(text.find(piece), std::string::npos) << '"' << piece << "\" is not in:\n" << text;
}

TEST(Help, OfTheProgramNamesEveryCommandAndGivesExamples) {
  const Finished finished = run_program({"--help"});
  EXPECT_EQ(finished.status, 0);
  for (const char* piece :
       {"run", "work-precision", "stability", "plan", "sensitivity", "plot", "report", "explain",
        "methods", "keys", "columns", "Examples:", "Exit status"}) {
    expect_in(finished.output, piece);
  }
}

TEST(Help, OfEveryCommandGivesAnExampleOfThatCommand) {
  for (const std::string command : {"run", "work-precision", "stability", "plan", "sensitivity",
                                    "plot", "report", "explain", "methods", "keys", "columns"}) {
    const Finished finished = run_program({command, "--help"});
    EXPECT_EQ(finished.status, 0) << command;
    expect_in(finished.output, "Example");
    expect_in(finished.output, "\n  subimpact " + command);
  }
}

TEST(Version, NamesTheLibraries) {
  const Finished finished = run_program({"--version"});
  EXPECT_EQ(finished.status, 0);
  for (const char* piece : {"subimpact ", "SUNDIALS ", "KLU ", "toml++ "}) {
    expect_in(finished.output, piece);
  }
}

TEST(Methods, AreListedWithTheirTables) {
  const Finished finished = run_program({"methods"});
  EXPECT_EQ(finished.status, 0);
  for (const char* piece : {"central-difference ", "erk ", "dop853 ", "8(5)"}) {
    expect_in(finished.output, piece);
  }
}

TEST(Columns, AreListedByTable) {
  const Finished finished = run_program({"columns"});
  EXPECT_EQ(finished.status, 0);
  for (const char* piece :
       {"events.csv: one row per sub-impact\n", "history.csv: ", "\n  w_c_m ",
        "sections.csv: ", "points.csv: ", "shapes.csv: ", "envelope.csv: ", "\n  max_moment_Nm "}) {
    expect_in(finished.output, piece);
  }
}

TEST(Keys, AreListedByTable) {
  const Finished finished = run_program({"keys"});
  EXPECT_EQ(finished.status, 0);
  for (const char* piece : {"[beam]\n", "youngs_modulus ", "[output]\n", "zone_gap "}) {
    expect_in(finished.output, piece);
  }
}

TEST(Keys, ArePrintedAsASchema) {
  const Finished finished = run_program({"keys", "--schema"});
  EXPECT_EQ(finished.status, 0);
  for (const char* piece : {"json-schema.org/draft/2020-12", "\"youngs_modulus\"", "\"hermite\""}) {
    expect_in(finished.output, piece);
  }
}

TEST(WorkPrecision, ChartsWhatItRanAndAdvises) {
  const TemporaryDirectory directory;
  const std::vector<std::string> command = {"work-precision", SUBIMPACT_PAPER_CASE,
                                            "--methods",      "central-difference,exponential",
                                            "--sections",     "elastic",
                                            "--set",          "time.end=3e-4",
                                            "--out",          "chart"};
  const Finished finished = run_program(command, directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  for (const char* piece : {"reference: exponential", "horizon: 286.242 us", "central-difference",
                            "cheapest setting", "0.001 us"}) {
    expect_in(finished.output, piece);
  }
  for (const char* name : {"work_precision.csv", "work_precision.svg", "work_precision.png"}) {
    EXPECT_TRUE(std::filesystem::exists(directory.path / "chart" / name)) << name;
  }
  const Finished again = run_program(command, directory.path);
  EXPECT_EQ(again.status, 0) << again.errors;
  expect_in(again.output, "points of an earlier study");
}

TEST(WorkPrecision, RefusesAMethodItDoesNotKnowBeforeItWritesAnything) {
  const TemporaryDirectory directory;
  const Finished finished = run_program(
      {"work-precision", SUBIMPACT_PAPER_CASE, "--methods", "leapfrog", "--out", "chart"},
      directory.path);
  EXPECT_EQ(finished.status, 2);
  expect_in(finished.errors, "--methods leapfrog: unknown method \"leapfrog\"");
  EXPECT_FALSE(std::filesystem::exists(directory.path / "chart"));
}

TEST(MethodsOption, IsBlamedForAMethodThatDoesNotExist) {
  const TemporaryDirectory directory;
  directory.write("case.toml", read_file(SUBIMPACT_PAPER_CASE));
  for (const char* command : {"compare", "work-precision", "stability"}) {
    const Finished finished =
        run_program({command, "case.toml", "--methods", "erk,rk4"}, directory.path);
    EXPECT_EQ(finished.status, 2) << command;
    EXPECT_EQ(finished.errors.find("--methods rk4: unknown method \"rk4\"; allowed: "), 0u)
        << finished.errors;
    expect_in(finished.errors, "central-difference, erk, nystrom, exponential");
    expect_in(finished.errors, "did you mean \"erk\"?");
    EXPECT_EQ(finished.errors.find("case.toml"), std::string::npos) << finished.errors;
  }
}

TEST(MethodsOption, IsBlamedForATableThatTheMethodDoesNotHave) {
  const Finished finished =
      run_program({"compare", SUBIMPACT_PAPER_CASE, "--methods", "nystrom:dprkn9"});
  EXPECT_EQ(finished.status, 2);
  expect_in(finished.errors, "--methods nystrom:dprkn9: unknown table \"dprkn9\"");
  expect_in(finished.errors,
            "allowed for nystrom: dprkn8, dprkn12; did you mean \"nystrom:dprkn8\"?");
}

TEST(Explain, NotesKeysWithoutEffectAndWarnsOfDoubtfulUnits) {
  const Finished finished =
      run_program({"explain", SUBIMPACT_PAPER_CASE, "--set", "model.elements=100", "--set",
                   "beam.youngs_modulus=71960"});
  EXPECT_EQ(finished.status, 0);
  expect_in(finished.errors,
            "subimpact: note: model.elements = 100 has no effect with model.mesh = \"cells\"\n");
  expect_in(finished.errors, "subimpact: warning: beam.youngs_modulus is 71960 Pa");
}

TEST(Stability, WritesThePartsAskedFor) {
  const TemporaryDirectory directory;
  const Finished finished =
      run_program({"stability", SUBIMPACT_PAPER_CASE, "--parts", "critical,contact", "--methods",
                   "central-difference", "--set", "model.segments=101", "--out", "s"},
                  directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  expect_in(finished.output, "euler-bernoulli");
  expect_in(finished.output, "spring, N/m");
  for (const char* name : {"critical_steps.csv", "critical_steps.svg", "stiff_contact.png"}) {
    EXPECT_TRUE(std::filesystem::exists(directory.path / "s" / name)) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(directory.path / "s" / "damping.csv"));
}

TEST(Stability, NamesThePartsThereAre) {
  const Finished finished =
      run_program({"stability", SUBIMPACT_PAPER_CASE, "--parts", "everything"});
  EXPECT_EQ(finished.status, 2);
  expect_in(finished.errors, "--parts everything: unknown part; allowed: critical");
}

TEST(Plan, WantsAnErrorWithItsUnit) {
  const Finished finished = run_program({"plan", SUBIMPACT_PAPER_CASE, "--error", "small"});
  EXPECT_EQ(finished.status, 2);
  expect_in(finished.errors, "is \"small\"; allowed: a time above 0 with its unit");
}

// The case fixes a mesh with spacing "points" and a step, none of which the advice has.
TEST(Plan, AdvisesOptionsThatTheProgramTakes) {
  const TemporaryDirectory directory;
  const std::vector<std::string> common = {SUBIMPACT_PAPERS_OWN_CASE, "--set",
                                           "model.section=elastic", "--set", "time.end=2.9e-4"};
  std::vector<std::string> planning = {"plan", "--within", "2us", "--out", "plan"};
  planning.insert(planning.end(), common.begin(), common.end());
  const Finished planned = run_program(planning, directory.path);
  ASSERT_EQ(planned.status, 0) << planned.errors;
  EXPECT_TRUE(std::filesystem::exists(directory.path / "plan" / "plan.svg"));
  const auto begin = planned.output.find("  --method ");
  ASSERT_NE(begin, std::string::npos) << planned.output;
  std::istringstream advice(planned.output.substr(begin, planned.output.find('\n', begin) - begin));
  std::vector<std::string> running = {"run", "--out", "run"};
  running.insert(running.end(), common.begin(), common.end());
  for (std::string word; advice >> word;) running.push_back(word);
  const Finished run = run_program(running, directory.path);
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_EQ(run.output.find("step of 1e-07"), std::string::npos) << run.output;
  expect_in(run.output, "exponential");
}

TEST(Explain, TellsWhatWillBeModelledAndWritesNothing) {
  const TemporaryDirectory directory;
  const Finished finished = run_program({"explain", SUBIMPACT_PAPER_CASE}, directory.path);
  EXPECT_EQ(finished.status, 0);
  EXPECT_EQ(finished.errors, "");
  for (const char* piece : {"critical step", "tolerances", "251", "0.0156337 mm", "time"}) {
    expect_in(finished.output, piece);
  }
  EXPECT_TRUE(std::filesystem::is_empty(directory.path));
}

TEST(Explain, FollowsOverrides) {
  const Finished finished =
      run_program({"explain", SUBIMPACT_PAPER_CASE, "--method", "central-difference", "--set",
                   "model.segments=101", "--set", "model.symmetry=off"});
  EXPECT_EQ(finished.status, 0);
  for (const char* piece : {"central-difference", "101 of the beam", "not used (model"}) {
    expect_in(finished.output, piece);
  }
}

}  // namespace
}  // namespace subimpact
