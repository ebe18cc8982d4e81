#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "process.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

constexpr const char* result_files[] = {"events.csv", "transitions.csv", "history.csv",
                                        "summary.json"};

void expect_in(const std::string& text, const std::string& piece) {
  EXPECT_NE(text.find(piece), std::string::npos) << '"' << piece << "\" is not in:\n" << text;
}

void expect_result_files(const fs::path& directory) {
  for (const char* name : result_files) {
    EXPECT_TRUE(fs::exists(directory / name)) << name;
    EXPECT_FALSE(read_file(directory / name).empty()) << name;
  }
}

nlohmann::json summary_in(const fs::path& directory) {
  return nlohmann::json::parse(read_file(directory / "summary.json"));
}

std::vector<std::string> short_run(const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"run", SUBIMPACT_PAPER_CASE, "--set", "time.end=2e-5"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(Run, WritesItsFilesAndPrintsTheTable) {
  const TemporaryDirectory directory;
  const Finished finished = run_program(short_run({"--out", "here"}), directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  EXPECT_EQ(finished.errors, "");
  for (const char* piece : {"completed at 20 us of 20 us", "peak force", "zone 1", "(open)"}) {
    expect_in(finished.output, piece);
  }
  expect_result_files(directory.path / "here");
  const auto summary = summary_in(directory.path / "here");
  EXPECT_EQ(summary.at("outcome").at("kind"), "completed");
  EXPECT_EQ(summary.at("case").at("time").at("end"), 2e-5);
  EXPECT_LT(summary.at("conservation").at("max_energy_error_relative"), 1e-6);
  // Yield of the first fibre is known: about 9.41 us on this mesh.
  EXPECT_NEAR(summary.at("first_yield").at("section_s").get<double>(), 9.41e-6, 0.05e-6);
}

TEST(Run, KeepsAHistoryRowEveryInterval) {
  const TemporaryDirectory directory;
  const Finished finished =
      run_program(short_run({"--out", "here", "--set", "output.interval=1e-5"}), directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  const std::string history = read_file(directory.path / "here" / "history.csv");
  expect_in(history, "\n1.0000000000000001e-05,");
  expect_in(history, "\n2.0000000000000002e-05,");
}

TEST(Run, WithoutADirectoryMakesOneNamedAfterTheCase) {
  const TemporaryDirectory directory;
  directory.write("strike.toml", read_file(SUBIMPACT_PAPER_CASE));
  const Finished finished =
      run_program({"run", "strike.toml", "--set", "time.end=1e-6"}, directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  expect_in(finished.output, "files in strike-results");
  expect_result_files(directory.path / "strike-results");
}

TEST(Run, MadeQuietSaysNothing) {
  const TemporaryDirectory directory;
  const Finished finished = run_program(short_run({"--quiet"}), directory.path);
  EXPECT_EQ(finished.status, 0);
  EXPECT_EQ(finished.output, "");
  EXPECT_EQ(finished.errors, "");
}

TEST(Run, NotesKeysWithoutEffectUnlessASettingMadeThemIdle) {
  const TemporaryDirectory directory;
  std::string text = read_file(SUBIMPACT_PAPER_CASE);
  text.replace(text.find("section = \"layers\""), 18, "section = \"exact\"");
  directory.write("case.toml", text);
  const Finished finished =
      run_program({"run", "case.toml", "--set", "time.end=1e-6"}, directory.path);
  EXPECT_EQ(finished.status, 0);
  EXPECT_EQ(finished.errors,
            "subimpact: note: model.layers = 40 has no effect with model.section = \"exact\"\n");
  EXPECT_EQ(run_program(short_run({"--set", "model.section=exact"}), directory.path).errors, "");
}

TEST(Run, WarnsOnceOfADoubtfulUnitAndKeepsTheWarning) {
  const TemporaryDirectory directory;
  const Finished finished = run_program(
      short_run({"--out", "here", "--set", "beam.density=2.6", "--set", "time.end=1e-6"}),
      directory.path);
  EXPECT_EQ(finished.status, 0);
  const std::string warning = "beam.density is 2.6 kg/m3";
  EXPECT_EQ(finished.errors.find("subimpact: warning: " + warning), 0u) << finished.errors;
  EXPECT_EQ(finished.errors.find(warning, 25), std::string::npos) << finished.errors;
  expect_in(finished.output, warning);
  const auto warnings = summary_in(directory.path / "here").at("warnings");
  ASSERT_EQ(warnings.size(), 1u);
  expect_in(warnings[0].get<std::string>(), "if g/cm3 was meant, write 2600");
}

TEST(Run, ThatLeavesTheModelsValidityNamesADoubtfulUnit) {
  const TemporaryDirectory directory;
  const Finished finished = run_program(
      {"run", SUBIMPACT_PAPER_CASE, "--set", "beam.youngs_modulus=71960"}, directory.path);
  EXPECT_EQ(finished.status, 2);
  expect_in(finished.errors, "the indentation reached the beam's thickness");
  expect_in(finished.errors, "check the unit: beam.youngs_modulus is 71960 Pa");
}

TEST(Run, ShowsNoProgressWhereNobodyLooks) {
  const TemporaryDirectory directory;
  EXPECT_EQ(run_program(short_run(), directory.path).errors, "");
}

TEST(Run, TakesTheMethodFromTheCommandLine) {
  const TemporaryDirectory directory;
  const Finished finished =
      run_program(short_run({"--out", "here", "--method", "central-difference"}), directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  EXPECT_EQ(summary_in(directory.path / "here").at("used").at("method"), "central-difference");
}

TEST(Run, BeyondTheStabilityLimitFailsWithStatus3AndKeepsItsFiles) {
  const TemporaryDirectory directory;
  const Finished finished = run_program(
      {"run", SUBIMPACT_PAPER_CASE, "--out", "here", "--method", "central-difference", "--set",
       "solver.step=4e-7", "--set", "study.beyond_critical=true", "--set", "time.end=1e-3"},
      directory.path);
  EXPECT_EQ(finished.status, 3);
  for (const char* piece :
       {"unstable at ", "method central-difference", "last event ", "use a smaller solver.step"}) {
    expect_in(finished.errors, piece);
  }
  expect_result_files(directory.path / "here");
  const auto summary = summary_in(directory.path / "here");
  EXPECT_EQ(summary.at("outcome").at("kind"), "unstable");
  EXPECT_LT(summary.at("outcome").at("time_s"), 1e-3);
}

TEST(Run, ThatLeavesTheModelsValidityEndsWithStatus2AndKeepsItsFiles) {
  const TemporaryDirectory directory;
  const Finished finished = run_program(
      short_run({"--out", "here", "--set", "striker.velocity=3000", "--set", "striker.mass=1"}),
      directory.path);
  EXPECT_EQ(finished.status, 2);
  expect_in(finished.errors, "the indentation reached the beam's thickness");
  expect_result_files(directory.path / "here");
  EXPECT_EQ(summary_in(directory.path / "here").at("outcome").at("kind"), "left-validity");
}

TEST(Run, WhoseResultsCannotBeWrittenEndsWithStatus3AndStillPrintsThem) {
  const TemporaryDirectory directory;
  fs::create_directories(directory.path / "here" / "history.csv" / "occupied");
  const Finished finished = run_program(short_run({"--out", "here"}), directory.path);
  EXPECT_EQ(finished.status, 3);
  expect_in(finished.errors, "history.csv: cannot be written");
  expect_in(finished.output, "zone 1");
}

TEST(Run, InterruptedKeepsWhatItHasComputed) {
  const TemporaryDirectory directory;
  const Finished finished =
      run_program({"run", SUBIMPACT_PAPER_CASE, "--out", "here", "--set", "solver.max_step=1e-9",
                   "--set", "time.end=1", "--set", "output.interval=0"},
                  directory.path, 1000);
  EXPECT_EQ(finished.status, 130);
  expect_in(finished.errors, "stopped");
  expect_result_files(directory.path / "here");
  EXPECT_EQ(summary_in(directory.path / "here").at("outcome").at("kind"), "stopped");
}

}  // namespace
}  // namespace subimpact
