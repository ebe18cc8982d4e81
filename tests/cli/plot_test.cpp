#include <fmt/format.h>

#include <regex>
#include <thread>

#include "fake_gnuplot.h"
#include "process.h"

namespace subimpact {
namespace {

using ARun = InADirectory;

// On a run in the folder "here".
class Plot : public testing::Test {
 protected:
  Plot() { make_run(); }
  void make_run() const {
    run_in(directory, paper("run", {"time.end=2e-4", "model.segments=51", "output.sections=0.5"},
                            {"--out", "here"}));
  }
  TemporaryDirectory directory;
};
using Report = Plot;
using FiguresThatCannotBeWritten = Plot;

TEST_F(Plot, DrawsTheFiguresOfARunIntoAFolderOfTheirOwn) {
  const Finished finished = run_in(directory, {"plot", "here"});
  EXPECT_EQ(finished.errors, "");
  for (const std::string name : {"response", "first-sub-impact", "indentation", "energies",
                                 "timeline", "bending", "shapes", "envelope"}) {
    expect_in(finished.output, name + ".svg, " + name + ".png");
    EXPECT_TRUE(directory.has("here/figures/" + name + ".svg")) << name;
    EXPECT_TRUE(directory.has("here/figures/" + name + ".png")) << name;
  }
}

TEST_F(Plot, OfARunLeavesNoFiguresToTheNextOne) {
  run_in(directory, {"plot", "here"});
  make_run();
  EXPECT_FALSE(directory.has("here/figures/timeline.svg"));
  run_in(directory, {"plot", "here"});
}

TEST_F(Plot, SaysOnStderrWhichSectionsItLeftOut) {
  std::string sections = "output.sections=0.5";
  for (int i = 1; i < 26; ++i) sections += ",0.3";
  run_in(directory,
         paper("run", {"time.end=1e-5", "model.segments=51", sections}, {"--out", "here"}));
  for (const char* command : {"plot", "report"}) {
    expect_in(run_in(directory, {command, "here"}).errors,
              "subimpact: note: not drawn: bending: sections 25 to 26");
  }
}

TEST_F(Plot, DrawsElsewhereIfAsked) {
  run_in(directory, {"plot", "here", "--out", "there"});
  EXPECT_TRUE(directory.has("there/timeline.svg"));
  EXPECT_FALSE(directory.has("here/figures/timeline.svg"));
}

TEST_F(Plot, OfWhatIsNoRunEndsWithStatus2AndSaysWhatIsMissing) {
  const Finished nowhere = run_in(directory, {"plot", "nowhere"}, 2);
  expect_in(nowhere.errors, "nowhere: is not a directory");
  expect_in(run_in(directory, {"plot", "."}, 2).errors, "summary.json: cannot be read");
}

TEST_F(ARun, KeepsSectionsWithErrorBarsToo) {
  run_in(directory, paper("run", {"time.end=1e-4", "model.segments=51", "output.sections=0.5"},
                          {"--out", "here", "--error-bars"}));
  EXPECT_TRUE(directory.has("here/sections.csv"));
}

TEST_F(Report, IsOnePageBesideTheRun) {
  expect_in(run_in(directory, {"report", "here"}).output, "here/report.html");
  const std::string page = directory.read("here/report.html");
  expect_in(page, "<!DOCTYPE html>", "</html>");
}

TEST_F(Report, OfSeveralRunsComparesThemInADirectoryOfItsOwn) {
  run_in(directory, paper("run", {"time.end=2e-4", "model.segments=51", "solver.rtol=1e-6"},
                          {"--out", "there"}));
  expect_in(run_in(directory, {"report", "here", "there", "--out", "both"}).output,
            "both/comparison.html");
  expect_in(directory.read("both/comparison.html"), "<td>solver.rtol</td>");
  expect_in(run_in(directory, {"report", "here", "there"}, 2).errors,
            "--out DIR must name the directory");
}

TEST_F(Plot, DrawsWithScriptsOfAUserAndHandsOutThoseThatAreMissing) {
  expect_in(run_in(directory, {"plot", "here", "--scripts", "mine"}).output, "mine/response.gp");
  directory.write("mine/timeline.gp", "plot nonsense from a user\n");
  expect_in(run_in(directory, {"plot", "here", "--scripts", "mine"}, 3).errors,
            "timeline.svg: gnuplot failed");
  EXPECT_TRUE(directory.has("here/figures/response.pdf"));
}

TEST_F(Plot, WithoutGnuplotEndsWithStatus2AndSaysHowToGetIt) {
  const Environment without_gnuplot("PATH", "/nowhere");
  expect_in(run_in(directory, {"plot", "here"}, 2).errors, "gnuplot is not installed",
            "apt-get install gnuplot-nox");
}

TEST_F(Plot, DrawsNoScriptThatHoldsTheDataOfAnotherRun) {
  run_in(directory, {"plot", "here", "--out", "drawn"});
  std::filesystem::create_directory(directory.path / "mine");
  std::filesystem::copy_file(directory.path / "drawn" / "timeline.gp",
                             directory.path / "mine" / "timeline.gp");
  expect_in(run_in(directory, {"plot", "here", "--scripts", "mine", "--out", "there"}, 2).errors,
            "mine/timeline.gp", "finished script");
  EXPECT_FALSE(directory.has("there"));
  EXPECT_FALSE(directory.has("mine/style.gp"));
}

TEST_F(Plot, RefusesTheDirectoryOfTheRunOrOfTheFiguresAsThatOfTheScripts) {
  for (const char* scripts : {"here", "./here/", "there"}) {
    expect_in(run_in(directory, {"plot", "here", "--scripts", scripts, "--out", "there"}, 2).errors,
              "is the directory of the run or of its figures; name another");
    EXPECT_FALSE(std::filesystem::exists(directory.path / scripts / "style.gp"));
  }
}

TEST_F(FiguresThatCannotBeWritten, LeaveTheOthersAndEndWithStatus3) {
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

TEST_F(Plot, TakesGnuplotWithItWhenASignalEndsIt) {
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

// A run in the folder "here", and its force as a recorder would have it: 0.25 us apart, 1 % too
// large, its clock 1234.5 us behind; in kN and us.
class ReportWithMeasurement : public testing::Test {
 protected:
  void SetUp() override {
    run_in(directory, paper("run", {"time.end=4e-4", "model.segments=51"}, {"--out", "here"}));
    std::ifstream history(directory.path / "here/history.csv");
    std::string line, text = "time [us];force [kN]\r\n";
    std::getline(history, line);
    ASSERT_TRUE(line.starts_with("time_s,force_N,")) << line;
    double t0 = 0.0, f0 = 0.0, t1 = 0.0, f1 = 0.0, t = -5e-5;
    while (std::getline(history, line)) {
      ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf", &t1, &f1), 2);
      for (; t <= t1; t += 2.5e-7) {
        const double force = t < 0.0 || t1 == t0 ? 0.0 : std::lerp(f0, f1, (t - t0) / (t1 - t0));
        text += fmt::format("{:.4f};{:.6f}\r\n", 1e6 * t + 1234.5, 1.01e-3 * force);
      }
      t0 = t1;
      f0 = f1;
    }
    directory.write("force.csv", text);
  }
  TemporaryDirectory directory;
};

TEST_F(ReportWithMeasurement, StatesShiftAndDifferencesAndShowsBothForces) {
  const Finished finished = run_in(directory, {"report", "here", "--measured", "force.csv"});
  expect_not_in(finished.errors, "warning");
  const auto number = [&](const std::string& pattern) {
    std::smatch found;
    return std::regex_search(finished.output, found, std::regex(pattern)) ? std::stod(found[1])
                                                                          : std::nan("");
  };
  EXPECT_NEAR(number("shift +([0-9.]+)"), 1234.5, 0.025);
  EXPECT_NEAR(number("largest force .* measured: ([-+0-9.]+) %"), -0.99, 0.06);
  EXPECT_NEAR(number("impulse .* measured: ([-+0-9.]+) %"), -0.99, 0.06);
  EXPECT_TRUE(directory.has("here/figures/measured.svg"));
  const std::string page = directory.read("here/report.html");
  expect_in(page, "Compared with the measurement", "figure-measured", "\"overlay\":[{");
  run_in(directory, {"report", "here"});
  expect_not_in(directory.read("here/report.html"), "Compared with the measurement");
}

TEST_F(ReportWithMeasurement, TakesAGivenShiftAndCutoff) {
  expect_in(run_in(directory, {"report", "here", "--measured", "force.csv", "--shift", "1.2345ms",
                               "--low-pass", "20kHz"})
                .output,
            "1234.5 us", "20 kHz", "as given");
}

TEST_F(ReportWithMeasurement, RefusesWithWhatIsAllowed) {
  const auto refusal = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"report", "here"});
    const Finished finished = run_in(directory, options, 2);
    return finished.errors;
  };
  directory.write("without.csv", "time,force\n0,1\n");
  expect_in(refusal({"--measured", "none.csv"}), "none.csv: cannot be read (No such");
  expect_in(refusal({"--measured", "without.csv"}), "unit of time (s, ms, us, ns, ps)");
  expect_in(refusal({"--shift", "1us"}), "--measured");
  expect_in(refusal({"--measured", "force.csv", "--shift", "3"}), "a time with its unit");
  expect_in(refusal({"--measured", "force.csv", "--shift", "10 s"}), "no time in common");
  expect_in(refusal({"--measured", "force.csv", "--low-pass", "-2kHz"}), "a frequency above 0");
  expect_in(refusal({"here", "--measured", "force.csv", "--out", "both"}), "one run");
}

TEST_F(ReportWithMeasurement, WarnsOfAForceThatIsNotThatOfTheCase) {
  std::string hum = "time_ms,force_N\n";
  for (int i = 0; i < 1000; ++i) hum += fmt::format("{},{}\n", 1e-3 * i, std::sin(0.1 * i));
  directory.write("hum.csv", hum);
  expect_in(run_in(directory, {"report", "here", "--measured", "hum.csv"}).errors, "warning",
            "correlation");
}

}  // namespace
}  // namespace subimpact
