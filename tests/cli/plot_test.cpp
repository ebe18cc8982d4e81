#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "fake_gnuplot.h"
#include "process.h"

namespace subimpact {
namespace {

void expect_in(const std::string& text, const std::string& piece) {
  EXPECT_NE(text.find(piece), std::string::npos) << '"' << piece << "\" is not in:\n" << text;
}

void make_run(const TemporaryDirectory& directory) {
  const Finished finished =
      run_program({"run", SUBIMPACT_PAPER_CASE, "--out", "here", "--set", "time.end=2e-4", "--set",
                   "model.segments=51", "--set", "output.sections=0.5"},
                  directory.path);
  ASSERT_EQ(finished.status, 0) << finished.errors;
}

/// Runs with a search path on which there is no gnuplot.
class WithoutGnuplot {
 public:
  WithoutGnuplot() : path_(std::getenv("PATH")) { ::setenv("PATH", "/nowhere", 1); }
  ~WithoutGnuplot() { ::setenv("PATH", path_.c_str(), 1); }

 private:
  std::string path_;
};

TEST(Plot, DrawsTheFiguresOfARunIntoAFolderOfTheirOwn) {
  const TemporaryDirectory directory;
  make_run(directory);
  const Finished finished = run_program({"plot", "here"}, directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  EXPECT_EQ(finished.errors, "");
  for (const std::string name : {"response", "first-sub-impact", "indentation", "energies",
                                 "timeline", "bending", "shapes", "envelope"}) {
    expect_in(finished.output, name + ".svg, " + name + ".png");
    EXPECT_TRUE(std::filesystem::exists(directory.path / "here/figures" / (name + ".svg")));
    EXPECT_TRUE(std::filesystem::exists(directory.path / "here/figures" / (name + ".png")));
  }
}

TEST(Plot, OfARunLeavesNoFiguresToTheNextOne) {
  const TemporaryDirectory directory;
  make_run(directory);
  ASSERT_EQ(run_program({"plot", "here"}, directory.path).status, 0);
  make_run(directory);
  EXPECT_FALSE(std::filesystem::exists(directory.path / "here/figures/timeline.svg"));
  EXPECT_EQ(run_program({"plot", "here"}, directory.path).status, 0);
}

TEST(Plot, SaysOnStderrWhichSectionsItLeftOut) {
  const TemporaryDirectory directory;
  std::string sections = "output.sections=0.5";
  for (int i = 1; i < 26; ++i) sections += ",0.3";
  ASSERT_EQ(run_program({"run", SUBIMPACT_PAPER_CASE, "--out", "here", "--set", "time.end=1e-5",
                         "--set", "model.segments=51", "--set", sections},
                        directory.path)
                .status,
            0);
  for (const char* command : {"plot", "report"}) {
    const Finished finished = run_program({command, "here"}, directory.path);
    EXPECT_EQ(finished.status, 0);
    expect_in(finished.errors, "subimpact: note: not drawn: bending: sections 25 to 26");
  }
}

TEST(Plot, DrawsElsewhereIfAsked) {
  const TemporaryDirectory directory;
  make_run(directory);
  EXPECT_EQ(run_program({"plot", "here", "--out", "there"}, directory.path).status, 0);
  EXPECT_TRUE(std::filesystem::exists(directory.path / "there" / "timeline.svg"));
  EXPECT_FALSE(std::filesystem::exists(directory.path / "here/figures/timeline.svg"));
}

TEST(Plot, OfWhatIsNoRunEndsWithStatus2AndSaysWhatIsMissing) {
  const TemporaryDirectory directory;
  const Finished nowhere = run_program({"plot", "nowhere"}, directory.path);
  EXPECT_EQ(nowhere.status, 2);
  expect_in(nowhere.errors, "nowhere: is not a directory");
  const Finished empty = run_program({"plot", "."}, directory.path);
  EXPECT_EQ(empty.status, 2);
  expect_in(empty.errors, "summary.json: cannot be read");
}

TEST(Run, KeepsSectionsWithErrorBarsToo) {
  const TemporaryDirectory directory;
  const Finished finished =
      run_program({"run", SUBIMPACT_PAPER_CASE, "--out", "here", "--error-bars", "--set",
                   "time.end=1e-4", "--set", "model.segments=51", "--set", "output.sections=0.5"},
                  directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  EXPECT_TRUE(std::filesystem::exists(directory.path / "here" / "sections.csv"));
}

TEST(Report, IsOnePageBesideTheRun) {
  const TemporaryDirectory directory;
  make_run(directory);
  const Finished finished = run_program({"report", "here"}, directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  expect_in(finished.output, "here/report.html");
  const std::string page = read_file(directory.path / "here" / "report.html");
  expect_in(page, "<!DOCTYPE html>");
  expect_in(page, "</html>");
}

TEST(Report, OfSeveralRunsComparesThemInADirectoryOfItsOwn) {
  const TemporaryDirectory directory;
  make_run(directory);
  ASSERT_EQ(run_program({"run", SUBIMPACT_PAPER_CASE, "--out", "there", "--set", "time.end=2e-4",
                         "--set", "model.segments=51", "--set", "solver.rtol=1e-6"},
                        directory.path)
                .status,
            0);
  const Finished finished =
      run_program({"report", "here", "there", "--out", "both"}, directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  expect_in(finished.output, "both/comparison.html");
  expect_in(read_file(directory.path / "both" / "comparison.html"), "<td>solver.rtol</td>");
  const Finished nowhere = run_program({"report", "here", "there"}, directory.path);
  EXPECT_EQ(nowhere.status, 2);
  expect_in(nowhere.errors, "--out DIR must name the directory");
}

TEST(Plot, DrawsWithScriptsOfAUserAndHandsOutThoseThatAreMissing) {
  const TemporaryDirectory directory;
  make_run(directory);
  const Finished first = run_program({"plot", "here", "--scripts", "mine"}, directory.path);
  EXPECT_EQ(first.status, 0) << first.errors;
  expect_in(first.output, "mine/response.gp");
  directory.write("mine/timeline.gp", "plot nonsense from a user\n");
  const Finished second = run_program({"plot", "here", "--scripts", "mine"}, directory.path);
  EXPECT_EQ(second.status, 3);
  expect_in(second.errors, "timeline.svg: gnuplot failed");
  EXPECT_TRUE(std::filesystem::exists(directory.path / "here/figures/response.pdf"));
}

TEST(Plot, WithoutGnuplotEndsWithStatus2AndSaysHowToGetIt) {
  const TemporaryDirectory directory;
  make_run(directory);
  const WithoutGnuplot hidden;
  const Finished finished = run_program({"plot", "here"}, directory.path);
  EXPECT_EQ(finished.status, 2);
  expect_in(finished.errors, "gnuplot is not installed");
  expect_in(finished.errors, "apt-get install gnuplot-nox");
}

TEST(Plot, DrawsNoScriptThatHoldsTheDataOfAnotherRun) {
  const TemporaryDirectory directory;
  make_run(directory);
  ASSERT_EQ(run_program({"plot", "here", "--out", "drawn"}, directory.path).status, 0);
  std::filesystem::create_directory(directory.path / "mine");
  std::filesystem::copy_file(directory.path / "drawn" / "timeline.gp",
                             directory.path / "mine" / "timeline.gp");
  const Finished finished =
      run_program({"plot", "here", "--scripts", "mine", "--out", "there"}, directory.path);
  EXPECT_EQ(finished.status, 2);
  expect_in(finished.errors, "mine/timeline.gp: is the finished script of a drawn figure");
  EXPECT_FALSE(std::filesystem::exists(directory.path / "there"));
  EXPECT_FALSE(std::filesystem::exists(directory.path / "mine" / "style.gp"));
}

TEST(Plot, RefusesTheDirectoryOfTheRunOrOfTheFiguresAsThatOfTheScripts) {
  const TemporaryDirectory directory;
  make_run(directory);
  for (const char* scripts : {"here", "./here/", "there"}) {
    const Finished finished =
        run_program({"plot", "here", "--scripts", scripts, "--out", "there"}, directory.path);
    EXPECT_EQ(finished.status, 2) << scripts;
    expect_in(finished.errors, "is the directory of the run or of its figures; name another");
    EXPECT_FALSE(std::filesystem::exists(directory.path / scripts / "style.gp"));
  }
}

TEST(FiguresThatCannotBeWritten, LeaveTheOthersAndEndWithStatus3) {
  const TemporaryDirectory directory;
  make_run(directory);
  ASSERT_EQ(run_program({"plot", "here", "--out", "whole"}, directory.path).status, 0);
  std::filesystem::path longest;
  for (const auto& entry : std::filesystem::directory_iterator(directory.path / "whole")) {
    if (longest.empty() || entry.file_size() > file_size(longest)) longest = entry.path();
  }
  const std::string name = longest.stem().string();
  const std::string other = name == "response" ? "timeline" : "response";
  for (const std::string command : {"plot", "report"}) {
    const Finished finished = run_program({command, "here", "--out", command}, directory.path, 0,
                                          SIGINT, file_size(longest) - 1);
    EXPECT_EQ(finished.status, 3) << command;
    expect_in(finished.errors, longest.filename().string() + ": cannot be written");
    const std::filesystem::path place =
        command == "plot" ? directory.path / "plot" : directory.path / "report/figures";
    EXPECT_FALSE(std::filesystem::exists(place / (name + ".gp")));
    for (const char* ending : {".svg", ".png", ".pdf", ".gp"}) {
      EXPECT_TRUE(std::filesystem::exists(place / (other + ending))) << other << ending;
    }
    EXPECT_FALSE(
        std::filesystem::exists(directory.path / "report/report.html"));  // longer than any figure
    if (command == "report") expect_in(finished.errors, "report.html: cannot be written");
  }
}

TEST(Plot, TakesGnuplotWithItWhenASignalEndsIt) {
  const TemporaryDirectory directory;
  make_run(directory);
  const std::filesystem::path number = directory.path / "number";
  // The parent of the command that limits gnuplot's time.
  const FakeGnuplot gnuplot(directory.path / "bin",
                            "echo $$ > " + number.string() +
                                "\nkill -TERM $(cut -d' ' -f4 /proc/$PPID/stat)\nexec sleep 300\n");
  EXPECT_EQ(run_program({"plot", "here"}, directory.path).status, -SIGTERM);
  ASSERT_TRUE(std::filesystem::exists(number));
  for (int i = 0; i < 300 && is_running(number); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_FALSE(is_running(number));
}

}  // namespace
}  // namespace subimpact
