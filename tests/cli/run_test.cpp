#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <nlohmann/json.hpp>

#include "address_sanitizer.h"
#include "process.h"
#include "subimpact/io/output_directory.h"
#include "subimpact/io/read_results.h"
#include "subimpact/io/results.h"
#include "unwrapped.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

constexpr const char* result_files[] = {"events.csv", "transitions.csv", "history.csv",
                                        "summary.json"};

void expect_in(const std::string& text, const std::string& piece) {
  EXPECT_NE(unwrapped(text).find(piece), std::string::npos) << '"' << piece << "\" is not in:\n"
                                                            << text;
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
  for (const char* piece : {": 20 us computed in ", "peak force", "zone 1", "(open)"}) {
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

TEST(Run, JudgesAStrikeOnMixedCellsByCoarserOnes) {
  const TemporaryDirectory directory;
  const Finished finished =
      run_program(short_run({"--set", "model.mesh=mixed", "--set", "model.segments=400", "--set",
                             "model.section=exact", "--set", "solver.method=central-difference",
                             "--set", "time.end=3e-4", "--verbose", "--out", "here"}),
                  directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  expect_in(finished.output, "400 mixed cells, one half by symmetry");
  expect_in(finished.output, "340 mixed cells, 280 mixed cells");
  expect_result_files(directory.path / "here");
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

TEST(Run, TakesErrorBarsOffAfterABlank) {
  const TemporaryDirectory directory;
  const Finished finished =
      run_program(short_run({"--error-bars", "off", "--out", "here"}), directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  EXPECT_TRUE(summary_in(directory.path / "here").at("error_bars").is_null());
}

TEST(Run, LeavesItsCaseWhichRepeatsIt) {
  const TemporaryDirectory directory;
  run_program(short_run({"--out", "here"}), directory.path);
  const Finished again = run_program({"run", "here/case.toml", "--out", "again"}, directory.path);
  EXPECT_EQ(again.status, 0) << again.errors;
  EXPECT_EQ(read_file(directory.path / "again" / "events.csv"),
            read_file(directory.path / "here" / "events.csv"));
}

TEST(Run, IntoTheDirectoryOfItsCaseLeavesTheCaseAsItIs) {
  const TemporaryDirectory directory;
  directory.write("case.toml", read_file(SUBIMPACT_PAPER_CASE));
  const Finished finished =
      run_program({"run", "case.toml", "--set", "time.end=1e-6", "--out", "."}, directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  EXPECT_EQ(read_file(directory.path / "case.toml"), read_file(SUBIMPACT_PAPER_CASE));
}

TEST(Run, AdvisesCommandsThatTheShellTakes) {
  const TemporaryDirectory directory;
  directory.write("it's a case.toml", read_file(SUBIMPACT_PAPER_CASE));
  const Finished finished =
      run_program({"run", "it's a case.toml", "--set", "time.end=3e-4", "--set", "title=A strike"},
                  directory.path);
  for (const char* piece : {" report ", "beam.theory=timoshenko", "model.segments=default"}) {
    expect_in(finished.output, piece);
  }
  std::istringstream lines(finished.output.substr(finished.output.find("  next ")));
  int n_commands = 0;
  for (std::string line; std::getline(lines, line) && !line.empty();) {
    const auto begin = line.find(SUBIMPACT_PROGRAM);
    if (begin == line.npos) continue;
    ++n_commands;
    const bool is_run = line.find(" run ") != line.npos;
    const std::string command =
        fmt::format("cd {} && {}{} > printed 2>&1", directory.path.string(), line.substr(begin),
                    is_run ? " --set time.end=3e-5 --out again" : "");
    EXPECT_EQ(std::system(command.c_str()), 0) << command << "\n"
                                               << read_file(directory.path / "printed");
  }
  EXPECT_GE(n_commands, 3) << finished.output;
}

TEST(NewCase, OfEverySceneIsCommentedAndRuns) {
  for (const char* scene : {"hammer", "ball-drop", "cantilever"}) {
    const TemporaryDirectory directory;
    const Finished text = run_program({"new", scene}, directory.path);
    EXPECT_EQ(text.status, 0) << text.errors;
    expect_in(text.output, "# ");
    directory.write("case.toml", text.output);
    const Finished finished =
        run_program({"run", "case.toml", "--set", "time.end=1 ms"}, directory.path);
    EXPECT_EQ(finished.status, 0) << finished.errors;
    EXPECT_EQ(finished.errors, "") << "a case to begin with has notes or warnings";
    expect_in(finished.output, "all certain");
    expect_in(finished.output, "energy");
  }
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
       {"unstable at ", "method central-difference", "last event ", "use a solver.step below"}) {
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

TEST(Run, WhoseResultsCanBeWrittenNowherePrintsThemAndLeavesTheOlderOnes) {
  const TemporaryDirectory directory;
  ASSERT_EQ(run_program(short_run({"--out", "here"}), directory.path).status, 0);
  const std::string before = read_file(directory.path / "here" / "manifest.json");
  const Finished finished =
      run_program(short_run({"--out", "here", "--quiet"}), directory.path, 0, SIGINT, 700);
  EXPECT_EQ(finished.status, 3);
  expect_in(finished.errors, "cannot be written (File too large)");
  expect_in(finished.errors, "nor can the results be written to a directory for temporary files");
  expect_in(finished.output, "zone 1");
  EXPECT_EQ(read_file(directory.path / "here" / "manifest.json"), before);
  EXPECT_NO_THROW(read_results(directory.path / "here"));
}

TEST(Run, IntoADirectoryThatCannotBeWrittenIsRefusedBeforeItBegins) {
  const TemporaryDirectory directory;
  const Finished finished = run_program({"run", SUBIMPACT_PAPER_CASE, "--out", "/proc/here",
                                         "--set", "time.end=1000", "--set", "output.interval=0"},
                                        directory.path);
  EXPECT_EQ(finished.status, 2);
  expect_in(finished.errors, "this output directory cannot be made");
}

TEST(Run, BesideAnotherRunIntoTheSameDirectoryIsRefused) {
  const TemporaryDirectory directory;
  OutputDirectory other(directory.path / "here", "run");
  const Finished finished = run_program(short_run({"--out", "here"}), directory.path);
  EXPECT_EQ(finished.status, 2);
  expect_in(finished.errors, "is writing into this directory; wait until it has ended");
}

// Rows held in memory would take 144 bytes each, and their text 345: 200 MB.
TEST(Memory, OfARunDoesNotGrowWithItsRows) {
  const TemporaryDirectory directory;
  const Finished finished =
      run_program({"run", SUBIMPACT_PAPER_CASE, "--out", "here", "--quiet", "--set",
                   "model.segments=41", "--set", "model.section=elastic", "--set", "time.end=1e-3",
                   "--set", "output.interval=2.5e-9"},
                  directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  const Finished drawn = run_program({"plot", "here"}, directory.path);
  EXPECT_EQ(drawn.status, 0) << drawn.errors;
  if (has_address_sanitizer) GTEST_SKIP() << "the address sanitizer takes memory of its own";
  EXPECT_LT(finished.megabytes, 100.0);
  EXPECT_LT(drawn.megabytes, 200.0);
  printf("run %.0f MB, plot %.0f MB for 400,000 rows\n", finished.megabytes, drawn.megabytes);
}

TEST(Memory, OfExplainIsSmallAndThatOfTheRunIsForetold) {
  const Finished finished =
      run_program({"explain", SUBIMPACT_PAPER_CASE, "--method", "exponential", "--set",
                   "model.section=elastic", "--set", "model.segments=20001"});
  EXPECT_EQ(finished.status, 0) << finished.errors;
  expect_in(finished.output, "memory                about 1.8e+03 MB");
  if (has_address_sanitizer) GTEST_SKIP() << "the address sanitizer takes memory of its own";
  EXPECT_LT(finished.megabytes, 100.0);
  printf("explain of 20,001 cells in modes: %.0f MB\n", finished.megabytes);
}

TEST(Memory, ThatARunMayNotTakeIsNamedBeforeItBegins) {
  if (has_address_sanitizer) GTEST_SKIP() << "no limit of memory with the address sanitizer";
  const TemporaryDirectory directory;
  const std::string refused = "(ulimit -v 2000000; '" SUBIMPACT_PROGRAM "' run '" +
                              std::string(SUBIMPACT_PAPER_CASE) +
                              "' --out here --method exponential --set model.section=elastic --set "
                              "model.segments=40001) 2> errors";
  const int status = std::system(("cd '" + directory.path.string() + "' && " + refused).c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  const std::string errors = read_file(directory.path / "errors");
  expect_in(errors, "solver.method takes some 3.3 GB of memory on this mesh of 20001 unknowns");
  expect_in(errors, "and the machine has 2 GB free; use a coarser mesh");
  EXPECT_FALSE(std::filesystem::exists(directory.path / "here"));
}

TEST(Run, WhoseRowsTheDiskCannotHoldIsRefusedBeforeItBegins) {
  const TemporaryDirectory directory;
  std::string sections = "sections = [0.5";
  for (int i = 1; i < 100'000; ++i) sections += ", 0.5";
  std::string text = read_file(SUBIMPACT_PAPER_CASE);
  const auto output = text.find("[output]");
  text.insert(output == std::string::npos ? text.size() : output + 8,
              (output == std::string::npos ? "\n[output]\n" : "\n") + sections + "]\n");
  directory.write("case.toml", text);
  const Finished finished = run_program(
      {"run", "case.toml", "--out", "here", "--set", "time.end=1", "--set", "output.interval=2e-7"},
      directory.path);
  EXPECT_EQ(finished.status, 2);
  expect_in(finished.errors, "here: the rows of this run take some 4.9e+04 GB, and the disk has");
  EXPECT_FALSE(std::filesystem::exists(directory.path / "here" / "manifest.json"));
}

TEST(Run, TakesTheDiskThatIsForetold) {
  const TemporaryDirectory directory;
  const Finished finished = run_program(short_run({"--out", "here", "--set", "output.interval=1e-8",
                                                   "--set", "output.sections=0.5,0.4,0.3"}),
                                        directory.path);
  ASSERT_EQ(finished.status, 0) << finished.errors;
  const std::filesystem::path here = directory.path / "here";
  const auto taken = static_cast<double>(std::filesystem::file_size(here / "history.csv") +
                                         std::filesystem::file_size(here / "sections.csv") +
                                         std::filesystem::file_size(here / "shapes.csv"));
  const double foreseen = foreseen_bytes(read_results(here).input);
  EXPECT_GT(foreseen, 0.8 * taken);
  EXPECT_LT(foreseen, 1.3 * taken);
}

TEST(Compare, ThatIsToldToEndPrintsTheMethodsThatHadEnded) {
  const TemporaryDirectory directory;
  const Finished early = run_program({"compare", SUBIMPACT_PAPER_CASE, "--methods", "erk", "--out",
                                      "tables", "--set", "time.end=1"},
                                     directory.path, 2000, SIGTERM);
  EXPECT_EQ(early.status, 128 + SIGTERM);
  expect_in(early.errors, "interrupted before a method was compared; nothing is written");
  EXPECT_FALSE(std::filesystem::exists(directory.path / "tables" / "manifest.json"));
}

TEST(Run, ThatIsToldToEndKeepsWhatItHasComputed) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1}) {
    const TemporaryDirectory directory;
    const Finished finished =
        run_program({"run", SUBIMPACT_PAPER_CASE, "--out", "here", "--set", "solver.max_step=1e-9",
                     "--set", "time.end=1", "--set", "output.interval=1e-6"},
                    directory.path, 700, signal);
    EXPECT_EQ(finished.status, 128 + signal);
    expect_in(finished.errors, "stopped");
    const FinishedRun run = read_results(directory.path / "here");
    EXPECT_EQ(run.result.outcome.kind, OutcomeKind::stopped);
    ASSERT_FALSE(run.result.history.empty());
    EXPECT_EQ(run.result.history.back().time, run.result.outcome.time);
  }
}

// The scene of the paper without any choice of mesh and method.
std::string open_case() {
  return "title = \"open\"\n"
         "beam = { length = 0.7112, width = 0.0163, thickness = 0.0075, density = 2600, "
         "youngs_modulus = 71.96e9, yield_stress = 150e6 }\n"
         "striker = { mass = 0.201, nose_radius = 0.01, velocity = 15.9 }\n"
         "time = { end = 0.25e-3 }\n";
}

TEST(RunWithin, MeetsAWishAndLeavesTheChoiceInItsFiles) {
  const TemporaryDirectory directory;
  directory.write("open.toml", open_case());
  const Finished finished =
      run_program({"run", "open.toml", "--within", "1us", "--out", "here"}, directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  const FinishedRun run = read_results(directory.path / "here");
  ASSERT_TRUE(run.result.wish);
  EXPECT_TRUE(run.result.wish->met);
  EXPECT_EQ(run.result.wish->wished, 1e-6);
  ASSERT_GE(run.result.sub_impacts.size(), 2u);
  EXPECT_NEAR(*run.result.sub_impacts[0].end, 201.476e-6, 1e-6);
  EXPECT_EQ(run.input.solver.method, Method::central_difference);
  EXPECT_GT(run.input.model.segments, 501);
  // Rows of one run alone, though several were made.
  EXPECT_EQ(run.result.history.front().time, 0.0);
  for (std::size_t i = 1; i < run.result.history.size(); ++i) {
    ASSERT_GE(run.result.history[i].time, run.result.history[i - 1].time);
  }
}

TEST(RunWithin, ThatTheCaseItselfWishesForNeedsNoOption) {
  const TemporaryDirectory directory;
  directory.write("open.toml", open_case() + "accuracy = { event_times = 2e-6 }\n");
  const Finished finished = run_program({"run", "open.toml", "--out", "here"}, directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  EXPECT_EQ(read_results(directory.path / "here").result.wish->wished, 2e-6);
}

TEST(RunWithin, AFixedMeshThatCannotMeetTheWishEndsWithStatus0AndTheReason) {
  const TemporaryDirectory directory;
  directory.write("open.toml", open_case());
  const Finished finished = run_program(
      {"run", "open.toml", "--within", "1ns", "--set", "model.segments=101", "--out", "here"},
      directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  expect_in(finished.output, "model.segments");
  const auto summary = summary_in(directory.path / "here");
  EXPECT_EQ(summary.at("wish_met"), false) << summary.at("wish");
}

TEST(RunWithin, NeedsAUnit) {
  const TemporaryDirectory directory;
  directory.write("open.toml", open_case());
  const Finished finished =
      run_program({"run", "open.toml", "--within", "0.1", "--out", "here"}, directory.path);
  EXPECT_EQ(finished.status, 2);
  expect_in(finished.errors, "with its unit, such as 1us");
  EXPECT_FALSE(fs::exists(directory.path / "here"));
}

TEST(RunWithin, DoesNotGoWithErrorBarsOfAnotherKind) {
  const TemporaryDirectory directory;
  directory.write("open.toml", open_case());
  const Finished finished =
      run_program({"run", "open.toml", "--within", "1us", "--error-bars=off"}, directory.path);
  EXPECT_EQ(finished.status, 2);
  expect_in(finished.errors, "--error-bars=off");
}

// The first touch is the only event time, and a mesh that the contact outlasts is doubted.
TEST(Run, ThatEndsWithinTheFirstContactStatesNoErrorOfItsEnd) {
  const TemporaryDirectory directory;
  const Finished run = run_program(
      {"run", SUBIMPACT_PAPER_CASE, "--set", "time.end=3.71e-5", "--set", "output.interval=0"},
      directory.path);
  ASSERT_EQ(run.status, 0) << run.errors;
  expect_in(run.output, "no event time up to 37.1 us but the first touch, which is exact");
  expect_in(run.output, "1 sub-impact, 0 to (open) us");
  expect_in(run.output, "\n   1             0        (open)");
  const FinishedRun read = read_results(directory.path / "case-results");
  const SubImpact& open = read.result.sub_impacts.front();
  EXPECT_FALSE(open.end);
  EXPECT_FALSE(open.end_error);
  EXPECT_EQ(open.start_error, 0.0);
  ASSERT_TRUE(open.peak_force_error);
  EXPECT_GT(*open.peak_force_error, 0.0);
  const Finished coarse =
      run_program({"run", SUBIMPACT_PAPER_CASE, "--set", "time.end=3.71e-5", "--set",
                   "output.interval=0", "--set", "model.segments=21", "--out", "coarse"},
                  directory.path);
  expect_in(coarse.output, "1 in 1 zone, all certain on this mesh");
  expect_in(coarse.output, "sub-impact 1: its contact lasts 30 us and the mesh shows none shorter");
}

TEST(Run, OfACaseThatFixesNothingHasErrorBarsAndItsOwnMesh) {
  const TemporaryDirectory directory;
  directory.write("open.toml", open_case());
  const Finished finished = run_program({"run", "open.toml", "--out", "here"}, directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  const FinishedRun run = read_results(directory.path / "here");
  ASSERT_TRUE(run.result.error_estimate);
  EXPECT_FALSE(run.result.wish);
  const SubImpact& first = run.result.sub_impacts.front();
  EXPECT_NEAR(*first.end, 201.476e-6, *first.end_error);
  EXPECT_LT(*first.end_error, 1e-6);
}

TEST(Run, WithoutErrorBarsTakesTheDefaultKeys) {
  const TemporaryDirectory directory;
  directory.write("open.toml", open_case());
  const Finished finished =
      run_program({"run", "open.toml", "--error-bars=off", "--out", "here"}, directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  const FinishedRun run = read_results(directory.path / "here");
  EXPECT_FALSE(run.result.error_estimate);
  EXPECT_EQ(run.input.model.segments, 501);
  EXPECT_EQ(run.input.solver.method, Method::erk);
}

// A cantilever struck at its tip; elements have a node there, cells do not.
std::string cantilever(const std::string& more) {
  std::string text =
      "beam = { length = 0.5, width = 0.02, thickness = 0.005, density = 7850, "
      "youngs_modulus = 210e9, ends = [\"clamped\", \"free\"]";
  text += more;
  text +=
      " }\nstriker = { mass = 0.1, nose_radius = 0.01, velocity = 1.0, position = 1.0 }\n"
      "time = { end = 1e-4 }\n";
  return text;
}

TEST(ACantileverStruckAtItsTip, NeedsNoKeyOfTheMesh) {
  const TemporaryDirectory directory;
  for (const char* more :
       {"", ", yield_stress = 250e6", ", theory = \"timoshenko\", poisson = 0.3"}) {
    const std::string input = directory.write("tip.toml", cantilever(more));
    const Finished finished = run_program({"run", input, "--out", "here"}, directory.path);
    EXPECT_EQ(finished.status, 0) << more << finished.errors;
    EXPECT_EQ(run_program({"explain", input}, directory.path).status, 0) << more;
  }
}

TEST(ARigidBeamThatTurnsFar, IsBeyondTheModel) {
  const TemporaryDirectory directory;
  const std::string input = directory.write(
      "rigid.toml",
      "beam = { length = 0.5, width = 0.02, thickness = 0.005, density = 7850, "
      "youngs_modulus = 210e9 }\n"
      "striker = { mass = 0.1, nose_radius = 0.01, velocity = 50.0, position = 0.05 }\n"
      "time = { end = 3e-3 }\nmodel = { mesh = \"rigid\" }\n");
  expect_in(run_program({"run", input, "--out", "here"}, directory.path).errors,
            "warning: the beam turns by up to 0.4");
}

TEST(RunWithin, IsNamedWhereItsTimeIsRefused) {
  const TemporaryDirectory directory;
  expect_in(run_program({"run", SUBIMPACT_PAPER_CASE, "--within", "1e300s"}, directory.path).errors,
            "--within 1e300s: accuracy.event_times");
}

// By bash, for the status of the first command of a pipe. Its reader ends before the program
// prints.
int status_with_reader_gone(const std::string& command, const std::filesystem::path& directory) {
  const std::string script = "cd '" + directory.string() + "' && bash -c \"(sleep 0.3; " + command +
                             ") | true; exit \\${PIPESTATUS[0]}\"";
  return WEXITSTATUS(std::system(script.c_str()));
}

TEST(Run, WhoseMessagesNobodyReadsEndsWithItsResults) {
  const TemporaryDirectory directory;
  const std::string command = std::string("'" SUBIMPACT_PROGRAM "' run '") + SUBIMPACT_PAPER_CASE +
                              "' --out here --set time.end=2e-5 --set beam.thickness=7.5 "
                              "2>&1 > /dev/null";
  EXPECT_EQ(status_with_reader_gone(command, directory.path), 0);
  EXPECT_TRUE(std::filesystem::exists(directory.path / "here" / "manifest.json"));
}

TEST(AListing, WhoseReaderHasEndedEndsAsOtherProgramsDo) {
  const TemporaryDirectory directory;
  EXPECT_EQ(status_with_reader_gone("'" SUBIMPACT_PROGRAM "' keys", directory.path), 128 + SIGPIPE);
}

}  // namespace
}  // namespace subimpact
