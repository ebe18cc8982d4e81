#include "process.h"

namespace subimpact {
namespace {

TEST(Help, OfEveryCommandGivesAnExampleOfThatCommand) {
  for (const std::string command : {"run", "work-precision", "stability", "plan", "sensitivity",
                                    "plot", "report", "explain", "methods", "keys", "columns"}) {
    expect_in(run_anywhere({command, "--help"}).output, "Example", "\n  subimpact " + command);
  }
}

TEST(Listings, NameWhatThereIs) {
  expect_in(run_anywhere({"--help"}).output, "run", "work-precision", "stability", "plan",
            "sensitivity", "plot", "report", "explain", "methods", "keys", "columns",
            "Examples:", "Exit status");
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

TEST(WorkPrecision, ChartsWhatItRanAndAdvises) {
  const TemporaryDirectory directory;
  const Words command = paper(
      "work-precision", {"time.end=3e-4"},
      {"--methods", "central-difference,exponential", "--sections", "elastic", "--out", "chart"});
  expect_in(run_in(directory, command).output, "reference: exponential", "horizon: 286.242 us",
            "central-difference", "cheapest setting", "0.001 us");
  for (const char* name : {"work_precision.csv", "work_precision.svg", "work_precision.png"}) {
    EXPECT_TRUE(directory.has(std::string("chart/") + name)) << name;
  }
  expect_in(run_in(directory, command).output, "points of an earlier study");
}

TEST(MethodsOption, IsBlamedForAMethodThatDoesNotExist) {
  const TemporaryDirectory directory;
  directory.write("case.toml", read_file(SUBIMPACT_PAPER_CASE));
  for (const char* command : {"compare", "work-precision", "stability"}) {
    const Finished finished = run_in(directory, {command, "case.toml", "--methods", "erk,rk4"}, 2);
    EXPECT_EQ(finished.errors.find("--methods rk4: unknown method \"rk4\"; allowed: "), 0u)
        << finished.errors;
    expect_in(finished.errors, "central-difference, erk, nystrom, exponential",
              "did you mean \"erk\"?");
    expect_not_in(finished.errors, "case.toml");
  }
}

TEST(Explain, NotesKeysWithoutEffectAndWarnsOfDoubtfulUnits) {
  expect_in(
      run_anywhere(paper("explain", {"model.elements=100", "beam.youngs_modulus=71960"})).errors,
      "subimpact: note: model.elements = 100 has no effect with model.mesh = \"cells\"\n",
      "subimpact: warning: beam.youngs_modulus is 71960 Pa");
}

TEST(Stability, WritesThePartsAskedFor) {
  const TemporaryDirectory directory;
  expect_in(run_in(directory, paper("stability", {"model.segments=101"},
                                    {"--parts", "critical,contact", "--methods",
                                     "central-difference", "--out", "s"}))
                .output,
            "euler-bernoulli", "spring, N/m");
  for (const char* name : {"critical_steps.csv", "critical_steps.svg", "stiff_contact.png"}) {
    EXPECT_TRUE(directory.has(std::string("s/") + name)) << name;
  }
  EXPECT_FALSE(directory.has("s/damping.csv"));
}

// The case fixes a mesh with spacing "points" and a step, none of which the advice has.
TEST(Plan, AdvisesOptionsThatTheProgramTakes) {
  const TemporaryDirectory directory;
  const Words common = {SUBIMPACT_PAPERS_OWN_CASE, "--set", "model.section=elastic", "--set",
                        "time.end=2.9e-4"};
  Words planning = {"plan", "--within", "2us", "--out", "plan"};
  planning.insert(planning.end(), common.begin(), common.end());
  const Finished planned = run_in(directory, planning);
  EXPECT_TRUE(directory.has("plan/plan.svg"));
  const auto begin = planned.output.find("  --method ");
  ASSERT_NE(begin, std::string::npos) << planned.output;
  std::istringstream advice(planned.output.substr(begin, planned.output.find('\n', begin) - begin));
  Words running = {"run", "--out", "run"};
  running.insert(running.end(), common.begin(), common.end());
  for (std::string word; advice >> word;) running.push_back(word);
  const Finished run = run_in(directory, running);
  expect_not_in(run.output, "step of 1e-07");
  expect_in(run.output, "exponential");
}

TEST(Explain, TellsWhatWillBeModelledAndWritesNothing) {
  const TemporaryDirectory directory;
  const Finished finished = run_in(directory, {"explain", SUBIMPACT_PAPER_CASE});
  EXPECT_EQ(finished.errors, "");
  expect_in(finished.output, "critical step", "tolerances", "251", "0.0156337 mm", "time");
  EXPECT_TRUE(std::filesystem::is_empty(directory.path));
}

TEST(Explain, FollowsOverrides) {
  expect_in(run_anywhere(paper("explain", {"model.segments=101", "model.symmetry=off"},
                               {"--method", "central-difference"}))
                .output,
            "central-difference", "101 of the beam", "not used (model");
}

}  // namespace
}  // namespace subimpact
