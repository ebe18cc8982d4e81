#include <thread>

#include "fake_gnuplot.h"
#include "process.h"

namespace subimpact {
namespace {

void make_run(const TemporaryDirectory& directory) {
  run_in(directory, paper("run", {"time.end=2e-4", "model.segments=51", "output.sections=0.5"},
                          {"--out", "here"}));
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
  const Finished finished = run_in(directory, {"plot", "here"});
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
  run_in(directory, {"plot", "here"});
  make_run(directory);
  EXPECT_FALSE(directory.has("here/figures/timeline.svg"));
  run_in(directory, {"plot", "here"});
}

TEST(Plot, SaysOnStderrWhichSectionsItLeftOut) {
  const TemporaryDirectory directory;
  std::string sections = "output.sections=0.5";
  for (int i = 1; i < 26; ++i) sections += ",0.3";
  run_in(directory,
         paper("run", {"time.end=1e-5", "model.segments=51", sections}, {"--out", "here"}));
  for (const char* command : {"plot", "report"}) {
    expect_in(run_in(directory, {command, "here"}).errors,
              "subimpact: note: not drawn: bending: sections 25 to 26");
  }
}

TEST(Plot, DrawsElsewhereIfAsked) {
  const TemporaryDirectory directory;
  make_run(directory);
  run_in(directory, {"plot", "here", "--out", "there"});
  EXPECT_TRUE(directory.has("there/timeline.svg"));
  EXPECT_FALSE(directory.has("here/figures/timeline.svg"));
}

TEST(Plot, OfWhatIsNoRunEndsWithStatus2AndSaysWhatIsMissing) {
  const TemporaryDirectory directory;
  const Finished nowhere = run_in(directory, {"plot", "nowhere"}, 2);
  expect_in(nowhere.errors, "nowhere: is not a directory");
  expect_in(run_in(directory, {"plot", "."}, 2).errors, "summary.json: cannot be read");
}

TEST(Run, KeepsSectionsWithErrorBarsToo) {
  const TemporaryDirectory directory;
  run_in(directory, paper("run", {"time.end=1e-4", "model.segments=51", "output.sections=0.5"},
                          {"--out", "here", "--error-bars"}));
  EXPECT_TRUE(directory.has("here/sections.csv"));
}

TEST(Report, IsOnePageBesideTheRun) {
  const TemporaryDirectory directory;
  make_run(directory);
  expect_in(run_in(directory, {"report", "here"}).output, "here/report.html");
  const std::string page = directory.read("here/report.html");
  expect_in(page, "<!DOCTYPE html>", "</html>");
}

TEST(Report, OfSeveralRunsComparesThemInADirectoryOfItsOwn) {
  const TemporaryDirectory directory;
  make_run(directory);
  run_in(directory, paper("run", {"time.end=2e-4", "model.segments=51", "solver.rtol=1e-6"},
                          {"--out", "there"}));
  expect_in(run_in(directory, {"report", "here", "there", "--out", "both"}).output,
            "both/comparison.html");
  expect_in(directory.read("both/comparison.html"), "<td>solver.rtol</td>");
  expect_in(run_in(directory, {"report", "here", "there"}, 2).errors,
            "--out DIR must name the directory");
}

TEST(Plot, DrawsWithScriptsOfAUserAndHandsOutThoseThatAreMissing) {
  const TemporaryDirectory directory;
  make_run(directory);
  expect_in(run_in(directory, {"plot", "here", "--scripts", "mine"}).output, "mine/response.gp");
  directory.write("mine/timeline.gp", "plot nonsense from a user\n");
  expect_in(run_in(directory, {"plot", "here", "--scripts", "mine"}, 3).errors,
            "timeline.svg: gnuplot failed");
  EXPECT_TRUE(directory.has("here/figures/response.pdf"));
}

TEST(Plot, WithoutGnuplotEndsWithStatus2AndSaysHowToGetIt) {
  const TemporaryDirectory directory;
  make_run(directory);
  const WithoutGnuplot hidden;
  expect_in(run_in(directory, {"plot", "here"}, 2).errors, "gnuplot is not installed",
            "apt-get install gnuplot-nox");
}

TEST(Plot, DrawsNoScriptThatHoldsTheDataOfAnotherRun) {
  const TemporaryDirectory directory;
  make_run(directory);
  run_in(directory, {"plot", "here", "--out", "drawn"});
  std::filesystem::create_directory(directory.path / "mine");
  std::filesystem::copy_file(directory.path / "drawn" / "timeline.gp",
                             directory.path / "mine" / "timeline.gp");
  const Finished finished =
      run_in(directory, {"plot", "here", "--scripts", "mine", "--out", "there"}, 2);
  expect_in(finished.errors, "mine/timeline.gp: is the finished script of a drawn figure");
  EXPECT_FALSE(directory.has("there"));
  EXPECT_FALSE(directory.has("mine/style.gp"));
}

TEST(Plot, RefusesTheDirectoryOfTheRunOrOfTheFiguresAsThatOfTheScripts) {
  const TemporaryDirectory directory;
  make_run(directory);
  for (const char* scripts : {"here", "./here/", "there"}) {
    expect_in(run_in(directory, {"plot", "here", "--scripts", scripts, "--out", "there"}, 2).errors,
              "is the directory of the run or of its figures; name another");
    EXPECT_FALSE(std::filesystem::exists(directory.path / scripts / "style.gp"));
  }
}

TEST(FiguresThatCannotBeWritten, LeaveTheOthersAndEndWithStatus3) {
  const TemporaryDirectory directory;
  make_run(directory);
  run_in(directory, {"plot", "here", "--out", "whole"});
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
    EXPECT_FALSE(directory.has("report/report.html"));  // longer than any figure
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
  run_in(directory, {"plot", "here"}, -SIGTERM);
  ASSERT_TRUE(std::filesystem::exists(number));
  for (int i = 0; i < 300 && is_running(number); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_FALSE(is_running(number));
}

}  // namespace
}  // namespace subimpact
