#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "address_sanitizer.h"
#include "process.h"
#include "run_files.h"
#include "subimpact/io/case_file.h"
#include "subimpact/io/output_directory.h"
#include "subimpact/io/results.h"
#include "unwrapped.h"

namespace subimpact {
namespace {

using RunWithin = InADirectory;
using Memory = InADirectory;
using ARun = InADirectory;

nlohmann::json summary_of(const TemporaryDirectory& directory) {
  return summary_in(directory.path / "here");
}

Words short_run(const Words& more = {}, const Words& settings = {}) {
  Words all = {"time.end=2e-5"};
  all.insert(all.end(), settings.begin(), settings.end());
  return paper("run", all, more);
}

// With its files in `here`.
Finished run_here(const TemporaryDirectory& directory, const Words& settings = {}, int status = 0,
                  Words more = {}) {
  more.insert(more.end(), {"--out", "here"});
  const Finished finished = run_in(directory, short_run(more, settings), status);
  for (const char* name : {"events.csv", "transitions.csv", "history.csv", "summary.json"}) {
    EXPECT_FALSE(directory.read(std::string("here/") + name).empty()) << name;
  }
  return finished;
}

TEST_F(ARun, WritesItsFilesAndPrintsTheTable) {
  const Finished finished = run_here(directory);
  EXPECT_EQ(finished.errors, "");  // progress is for terminals
  expect_in(unwrapped(finished.output), "1 sub-impact in 20 us, ", "peak force", "zone 1",
            "(open)");
  const auto summary = summary_of(directory);
  EXPECT_EQ(summary.at("outcome").at("kind"), "completed");
  EXPECT_EQ(summary.at("case").at("time").at("end"), 2e-5);
  EXPECT_LT(summary.at("conservation").at("max_energy_error_relative"), 1e-6);
  // Yield of the first fibre is known: about 9.41 us on this mesh.
  EXPECT_NEAR(summary.at("first_yield").at("section_s").get<double>(), 9.41e-6, 0.05e-6);
}

TEST_F(ARun, WithoutADirectoryMakesOneNamedAfterTheCase) {
  directory.write("strike.toml", read_file(SUBIMPACT_PAPER_CASE));
  expect_in(run_in(directory, {"run", "strike.toml", "--set", "time.end=1e-6"}).output,
            "files in strike-results");
  EXPECT_TRUE(directory.has("strike-results/summary.json"));
}

TEST_F(ARun, LeavesItsCaseWhichRepeatsIt) {
  run_program(short_run({"--out", "here"}), directory.path);
  const Finished again = run_in(directory, {"run", "here/case.toml", "--out", "again"});
  EXPECT_EQ(directory.read("again/events.csv"), directory.read("here/events.csv"));
}

TEST_F(ARun, IntoTheDirectoryOfItsCaseLeavesTheCaseAsItIs) {
  directory.write("case.toml", read_file(SUBIMPACT_PAPER_CASE));
  run_in(directory, {"run", "case.toml", "--set", "time.end=1e-6", "--out", "."});
  EXPECT_EQ(directory.read("case.toml"), read_file(SUBIMPACT_PAPER_CASE));
}

TEST(NewCase, OfEverySceneIsCommentedAndRuns) {
  const std::string listing = run_in(TemporaryDirectory(), {"new"}).output;
  for (const char* scene : {"hammer", "ball-drop", "cantilever", "stop", "repeated-strikes", "tube",
                            "rollers", "ensemble"}) {
    const TemporaryDirectory directory;
    const Finished text = run_in(directory, {"new", scene});
    expect_in(text.output, "# ");
    const std::string first_line = text.output.substr(2, text.output.find('\n') - 1);
    expect_in(listing, fmt::format("{:<18} {}", scene, first_line));
    directory.write("case.toml", text.output);
    const Finished finished = run_in(directory, {"run", "case.toml", "--set", "time.end=1 ms"});
    // Pinned ends of a struck beam pull, and a run says so; a case to begin with has nothing else.
    if (scene == std::string_view("cantilever")) {
      EXPECT_EQ(finished.errors, "");
    }
    std::istringstream warnings(finished.errors);
    for (std::string line; std::getline(warnings, line);)
      expect_in(line, "pulls the beam by up to");
    expect_in(unwrapped(finished.output), "all certain", "energy");
  }
}

TEST_F(ARun, MadeQuietSaysNothing) {
  const Finished finished = run_in(directory, short_run({"--quiet"}));
  EXPECT_EQ(finished.output, "");
  EXPECT_EQ(finished.errors, "");
}

TEST_F(ARun, NotesKeysWithoutEffectUnlessASettingMadeThemIdle) {
  std::string text = read_file(SUBIMPACT_PAPER_CASE);
  text.replace(text.find("section = \"layers\""), 18, "section = \"exact\"");
  directory.write("case.toml", text);
  const Finished finished = run_in(directory, {"run", "case.toml", "--set", "time.end=1e-6"});
  EXPECT_EQ(finished.errors,
            "subimpact: note: model.layers = 40 has no effect with model.section = \"exact\"\n");
  EXPECT_EQ(run_here(directory, {"model.section=exact"}).errors, "");
}

TEST_F(ARun, WarnsOnceOfADoubtfulUnitAndKeepsTheWarning) {
  const Finished finished = run_here(directory, {"beam.density=2.6", "time.end=1e-6"});
  const std::string warning = "beam.density is 2.6 kg/m3";
  EXPECT_EQ(finished.errors.find("subimpact: warning: " + warning), 0u) << finished.errors;
  EXPECT_EQ(finished.errors.find(warning, 25), std::string::npos) << finished.errors;
  expect_in(unwrapped(finished.output), warning);
  const auto warnings = summary_of(directory).at("warnings");
  ASSERT_EQ(warnings.size(), 1u);
  expect_in(warnings[0].get<std::string>(), "if g/cm3 was meant, write 2600");
}

TEST_F(ARun, BeyondTheStabilityLimitFailsWithStatus3AndKeepsItsFiles) {
  expect_in(run_in(directory,
                   paper("run", {"solver.step=4e-7", "study.beyond_critical=true", "time.end=1e-3"},
                         {"--out", "here", "--method", "central-difference"}),
                   3)
                .errors,
            "unstable at ", "method central-difference", "last event ", "use a solver.step below");
  const auto summary = summary_of(directory);
  EXPECT_EQ(summary.at("outcome").at("kind"), "unstable");
  EXPECT_EQ(summary.at("used").at("method"), "central-difference") << "of the command line";
  EXPECT_LT(summary.at("outcome").at("time_s"), 1e-3);
}

TEST_F(ARun, ThatLeavesTheModelsValidityEndsWithStatus2AndKeepsItsFiles) {
  expect_in(run_here(directory, {"striker.velocity=3000", "striker.mass=1"}, 2).errors,
            "the indentation reached the beam's thickness");
  EXPECT_EQ(summary_of(directory).at("outcome").at("kind"), "left-validity");
  expect_in(run_in(directory, paper("run", {"beam.youngs_modulus=71960"}), 2).errors,
            "check the unit: beam.youngs_modulus is 71960 Pa");
}

TEST_F(ARun, WhoseResultsCannotBeWrittenPrintsThemAndLeavesTheOlderOnes) {
  run_here(directory);
  const std::string before = directory.read("here/manifest.json");
  const Finished finished =
      run_program(short_run({"--out", "here", "--quiet"}), directory.path, 0, SIGINT, 4000);
  EXPECT_EQ(finished.status, 3);
  expect_in(finished.errors, "cannot be written (File too large)");
  expect_in(unwrapped(finished.output), "zone 1");
  EXPECT_EQ(directory.read("here/manifest.json"), before);
  EXPECT_EQ(summary_of(directory).at("outcome").at("kind"), "completed");
}

TEST_F(ARun, KeepsSectionsWithErrorBarsToo) {
  run_in(directory, paper("run", {"time.end=1e-4", "model.segments=51", "output.sections=0.5"},
                          {"--out", "here", "--error-bars=all"}));
  EXPECT_TRUE(directory.has("here/sections.csv"));
}

TEST_F(ARun, LeavesNoFiguresOfTheRunBefore) {
  run_here(directory);
  const std::filesystem::path place = directory.path / "here/figures";
  {
    OutputDirectory figures(
        place, "figures",
        nlohmann::json::parse(directory.read("here/manifest.json")).at("identity"));
    std::ofstream(figures.staging() / "timeline.svg") << "<svg/>";
    figures.commit();
  }
  run_here(directory);
  EXPECT_FALSE(std::filesystem::exists(place / "timeline.svg"));
}

TEST_F(ARun, IntoADirectoryThatCannotBeWrittenIsRefusedBeforeItBegins) {
  expect_in(run_in(directory,
                   paper("run", {"time.end=1000", "output.interval=0"}, {"--out", "/proc/here"}), 2)
                .errors,
            "this output directory cannot be made");
}

// Rows held in memory would take 144 bytes each, and their text 345: 200 MB.
TEST_F(Memory, OfARunDoesNotGrowWithItsRows) {
  const Finished finished = run_in(directory, paper("run",
                                                    {"model.segments=41", "model.section=elastic",
                                                     "time.end=1e-3", "output.interval=2.5e-9"},
                                                    {"--out", "here", "--quiet"}));
  const Finished page = run_in(directory, {"report", "here"});
  if (has_address_sanitizer) GTEST_SKIP() << "the address sanitizer takes memory of its own";
  EXPECT_LT(finished.megabytes, 100.0);
  EXPECT_LT(page.megabytes, 200.0);
}

TEST_F(Memory, OfExplainIsSmallAndThatOfTheRunIsForecast) {
  const Finished finished = run_anywhere(paper(
      "explain", {"model.section=elastic", "model.segments=20001"}, {"--method", "exponential"}));
  // Two matrices of 10,001 modes.
  expect_in(finished.output, "memory                about 16");
  if (has_address_sanitizer) GTEST_SKIP() << "the address sanitizer takes memory of its own";
  EXPECT_LT(finished.megabytes, 100.0);
}

TEST_F(Memory, ThatARunMayNotTakeIsNamedBeforeItBegins) {
  if (has_address_sanitizer) GTEST_SKIP() << "no limit of memory with the address sanitizer";
  EXPECT_EQ(shell("(ulimit -v 2000000; subimpact run '" SUBIMPACT_PAPER_CASE
                  "' --out here --method exponential --set model.section=elastic "
                  "--set model.segments=40001) 2> errors",
                  directory.path),
            2);
  expect_in(directory.read("errors"), "solver.method", "3.3 GB", "20001 unknowns", "2 GB free");
  EXPECT_FALSE(directory.has("here"));
}

TEST_F(ARun, TakesTheDiskThatIsForecast) {
  run_here(directory, {"output.interval=1e-8", "output.sections=0.5,0.4,0.3"});
  const std::filesystem::path here = directory.path / "here";
  double taken = 0.0;
  for (const char* name : {"history.csv", "sections.csv", "shapes.csv"}) {
    taken += static_cast<double>(std::filesystem::file_size(here / name));
  }
  EXPECT_NEAR(expected_bytes(read_case_file(here / "case.toml").value), 1.05 * taken, 0.25 * taken);
}

TEST(Compare, ThatIsToldToEndPrintsTheMethodsThatHadEnded) {
  const TemporaryDirectory directory;
  const Finished early =
      run_program(paper("compare", {"time.end=1"}, {"--methods", "erk", "--out", "tables"}),
                  directory.path, 2000, SIGTERM);
  EXPECT_EQ(early.status, 128 + SIGTERM);
  expect_in(early.errors, "interrupted before a method was compared; nothing is written");
  EXPECT_FALSE(directory.has("tables/manifest.json"));
}

TEST_F(ARun, ThatIsToldToEndKeepsWhatItHasComputed) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1}) {
    const TemporaryDirectory directory;
    const Finished finished =
        run_program(paper("run", {"solver.max_step=1e-9", "time.end=1", "output.interval=1e-6"},
                          {"--out", "here"}),
                    directory.path, 700, signal);
    EXPECT_EQ(finished.status, 128 + signal);
    expect_in(finished.errors, "stopped");
    const auto outcome = summary_of(directory).at("outcome");
    EXPECT_EQ(outcome.at("kind"), "stopped");
    const std::vector<TableRow> history = table_in(directory.path / "here/history.csv");
    ASSERT_FALSE(history.empty());
    EXPECT_EQ(history.back().number("time_s"), outcome.at("time_s"));
  }
}

// A run of the paper's scene without any choice of mesh and method.
nlohmann::json open_run(const TemporaryDirectory& directory, const Words& more,
                        const std::string& lines = {}) {
  directory.write("open.toml", open_case + lines);
  Words words = {"run", "open.toml", "--out", "here"};
  words.insert(words.end(), more.begin(), more.end());
  run_in(directory, words);
  return summary_of(directory);
}

// The paper's own model of its scene.
const Words papers_model = {"--set", "beam.theory=rayleigh", "--set", "contact.law=foundation"};

TEST_F(RunWithin, MeetsAWishAndLeavesTheChoiceInItsFiles) {
  Words words = {"--within", "1us"};
  words.insert(words.end(), papers_model.begin(), papers_model.end());
  const auto run = open_run(directory, words);
  EXPECT_EQ(run.at("wish_met"), true);
  EXPECT_EQ(run.at("wish").at("event_times_s"), 1e-6);
  const std::vector<TableRow> hits = table_in(directory.path / "here/events.csv");
  ASSERT_GE(hits.size(), 2u);
  EXPECT_NEAR(hits[0].number("end_s"), 201.476e-6, 1e-6);
  EXPECT_EQ(run.at("case").at("solver").at("method"), "central-difference");
  EXPECT_GT(run.at("case").at("model").at("segments"), 501);
  // Rows of one run alone, though several were made.
  const std::vector<TableRow> history = table_in(directory.path / "here/history.csv");
  EXPECT_EQ(history.front().number("time_s"), 0.0);
  for (std::size_t i = 1; i < history.size(); ++i) {
    ASSERT_GE(history[i].number("time_s"), history[i - 1].number("time_s"));
  }
}

TEST_F(RunWithin, ThatTheCaseItselfWishesForNeedsNoOption) {
  const auto run = open_run(directory, {}, "accuracy = { event_times = 2e-6 }\n");
  EXPECT_EQ(run.at("wish").at("event_times_s"), 2e-6);
}

// The first touch is the only event time.
TEST_F(ARun, ThatEndsWithinTheFirstContactStatesNoErrorOfItsEnd) {
  const Finished run =
      run_in(directory, paper("run", {"time.end=3.71e-5", "output.interval=0"}, {"--verbose"}));
  expect_in(unwrapped(run.output),
            "no event time up to 37.1 us but the first touch, which is exact",
            "up to 8.8 +- 5.7 kN", "\n   1             0        (open)");
  const TableRow open = table_in(directory.path / "case-results/events.csv").at(0);
  EXPECT_FALSE(open.contains("end_s") || open.contains("end_error_s"));
  EXPECT_EQ(open.number("start_error_s"), 0.0);
  EXPECT_GT(open.number("peak_force_error_N"), 0.0);
}

TEST_F(ARun, OfACaseThatLeavesItsModelOpenChoosesItAndTheCaseItWritesIsThatModel) {
  const auto run = open_run(directory, {"--set", "solver.rtol=1e-8"});
  EXPECT_EQ(run.at("case").at("beam").at("theory"), "timoshenko");
  EXPECT_EQ(run.at("case").at("contact").at("law"), "line");
  expect_in(run.at("model_choice").get<std::string>(), "beam.theory = \"timoshenko\"",
            "contact.law = \"line\"");
  EXPECT_GT(run.at("body_errors").at("error").at("peak_force_N"), 0.0);
  directory.write("written.toml", directory.read("here/case.toml"));
  run_in(directory, {"run", "written.toml", "--out", "again", "--body-errors=off"});
  const auto again = summary_in(directory.path / "again");
  EXPECT_TRUE(again.at("body_errors").is_null());
  EXPECT_EQ(again.at("model_choice"), "beam.poisson = 0.3: none is given");
  EXPECT_EQ(table_in(directory.path / "again/events.csv").at(0).at("end_s"),
            table_in(directory.path / "here/events.csv").at(0).at("end_s"));
  EXPECT_EQ(again.at("maxima"), run.at("maxima"));
}

TEST_F(ARun, OfACaseThatFixesNothingHasErrorBarsAndItsOwnMesh) {
  const auto run = open_run(directory, papers_model);
  EXPECT_FALSE(run.at("error_bars").is_null());
  EXPECT_TRUE(run.at("wish").is_null());
  const TableRow first = table_in(directory.path / "here/events.csv").at(0);
  EXPECT_NEAR(first.number("end_s"), 201.476e-6, first.number("end_error_s"));
  EXPECT_LT(first.number("end_error_s"), 1e-6);
}

TEST_F(ARun, WithoutErrorBarsTakesTheDefaultKeys) {
  const auto run = open_run(directory, {"--error-bars", "off"});
  EXPECT_TRUE(run.at("error_bars").is_null());
  EXPECT_EQ(run.at("case").at("model").at("segments"), 501);
  EXPECT_EQ(run.at("case").at("solver").at("method"), "erk");
}

// By bash, for the status of the first command of a pipe. Its reader ends before the program
// prints.
int status_with_reader_gone(const std::string& command, const std::filesystem::path& directory) {
  return shell("bash -c \"(sleep 0.3; " + command + ") | true; exit \\${PIPESTATUS[0]}\"",
               directory);
}

TEST_F(ARun, WhoseMessagesNobodyReadsEndsWithItsResults) {
  const std::string command = std::string("'" SUBIMPACT_PROGRAM "' run '") + SUBIMPACT_PAPER_CASE +
                              "' --out here --set time.end=2e-5 --set beam.thickness=7.5 "
                              "2>&1 > /dev/null";
  EXPECT_EQ(status_with_reader_gone(command, directory.path), 0);
  EXPECT_TRUE(directory.has("here/manifest.json"));
}

TEST(AListing, WhoseReaderHasEndedEndsAsOtherProgramsDo) {
  const TemporaryDirectory directory;
  EXPECT_EQ(status_with_reader_gone("'" SUBIMPACT_PROGRAM "' keys", directory.path), 128 + SIGPIPE);
}

TEST(RepeatedStrikes, OfTheProgramHaveARowEachInATableAndOnTheScreen) {
  const TemporaryDirectory here;
  expect_in(run_in(here, paper("run",
                               {"time.end=1 ms", "model.segments=201", "repeat.strikes=3",
                                "beam.ends=pinned,pinned"},
                               {"--out", "here"}))
                .output,
            "strike sub-impacts");
  const std::vector<TableRow> strikes = table_in(here.path / "here/strikes.csv"),
                              hits = table_in(here.path / "here/events.csv");
  ASSERT_EQ(strikes.size(), 3U);
  EXPECT_EQ(strikes.back().at("sub_impacts"), std::to_string(hits.size()));
  EXPECT_EQ(strikes.back().at("dent_m"), hits.back().at("residual_indentation_m"));
  expect_in(run_in(here, paper("compare", {"repeat.strikes=3"}, {"--methods", "erk"}), 2).errors,
            "only `subimpact run` strikes more than once");
}

}  // namespace
}  // namespace subimpact
