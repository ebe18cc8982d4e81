#include <fmt/format.h>

#include <regex>

#include "environment.h"
#include "process.h"
#include "run_files.h"
#include "subimpact/io/output_directory.h"

namespace subimpact {
namespace {

using ARun = InADirectory;

// On a run in the folder "here".
class Report : public testing::Test {
 protected:
  Report() {
    run_in(directory, paper("run", {"time.end=2e-4", "model.segments=51"}, {"--out", "here"}));
  }
  TemporaryDirectory directory;
};

TEST(APlot, WithoutPythonEndsWithStatus2AndOneLineThatSaysHowToGetIt) {
  const Environment nowhere("SUBIMPACT_PYTHON_EXECUTABLE", "/nowhere/python3");
  const std::string errors = run_anywhere({"plot", "here"}, 2).errors;
  expect_in(errors, "/nowhere/python3: cannot be run", "python3-matplotlib");
  EXPECT_EQ(count_in(errors, "\n"), 1u);
}

TEST(ThePython, OfTheProgramFindsItsPackageAndTakesAllArguments) {
  const char* look = "import importlib.util as u; print(u.find_spec('subimpact').origin)";
  expect_in(run_anywhere({"python", "-c", look}, 0).output, "python/subimpact/__init__.py");
  run_anywhere({"python", "-c", "import sys; sys.exit(len(sys.argv))", "--help", "-x"}, 3);
  const Environment nowhere("SUBIMPACT_PYTHON_EXECUTABLE", "/nowhere/python3");
  expect_in(run_anywhere({"python"}, 2).errors, "/nowhere/python3: cannot be run");
}

TEST_F(ARun, KeepsSectionsWithErrorBarsToo) {
  run_in(directory, paper("run", {"time.end=1e-4", "model.segments=51", "output.sections=0.5"},
                          {"--out", "here", "--error-bars=all"}));
  EXPECT_TRUE(directory.has("here/sections.csv"));
}

TEST_F(Report, IsOnePageBesideTheRun) {
  expect_in(run_in(directory, {"report", "here"}).output, "here/report.html");
  const std::string page = directory.read("here/report.html");
  expect_in(page, "<!DOCTYPE html>", "</html>");
  EXPECT_FALSE(directory.has("here/figures"));
}

TEST_F(Report, HasNoFiguresOfTheRunBefore) {
  const std::filesystem::path place = directory.path / "here/figures";
  {
    OutputDirectory figures(
        place, "figures",
        nlohmann::json::parse(directory.read("here/manifest.json")).at("identity"));
    std::ofstream(figures.staging() / "timeline.svg") << "<svg/>";
    figures.commit();
  }
  run_in(directory, paper("run", {"time.end=1e-4", "model.segments=51"}, {"--out", "here"}));
  EXPECT_FALSE(std::filesystem::exists(place / "timeline.svg"));
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
  const std::string page = directory.read("here/report.html");
  expect_in(page, "Compared with the measurement", "\"overlay\":[{", "figure-measured");
  EXPECT_TRUE(directory.has("here/figures/measured.svg"));
  run_in(directory, {"report", "here"});
  expect_not_in(directory.read("here/report.html"), "Compared with the measurement");
}

TEST_F(ReportWithMeasurement, LaysAStrainBesideTheGaugeThatIsNamed) {
  run_in(directory, paper("run",
                          {"time.end=4e-4", "model.segments=51", "output.interval=1e-6",
                           "output.gauges=[{position=0.3},{position=0.5,face=\"front\"}]"},
                          {"--out", "gauged"}));
  std::string text = "time (us),strain (um/m)\n";
  for (const TableRow& row : table_in(directory.path / "gauged/history.csv")) {
    text += fmt::format("{:.4f},{:.6f}\n", 1e6 * row.number("time_s") + 20.0,
                        1.02e6 * row.number("gauge_2_strain"));
  }
  directory.write("strain.csv", text);
  const auto report = [&](const std::string& gauge, int status = 0) {
    return run_in(directory, {"report", "gauged", "--measured", "strain.csv", "--gauge", gauge},
                  status);
  };
  expect_in(report("2").output, "shift               20.0", "measured: -2 %");
  expect_in(directory.read("gauged/report.html"), "Measured and computed strain", "data-strain");
  expect_not_in(report("1").output, "measured: -2 %");
  expect_in(report("3", 2).errors, "no gauge_3_strain");
}

TEST_F(ReportWithMeasurement, TakesAGivenShiftAndCutoffAndHowTheFileIsRead) {
  const std::string text = directory.read("force.csv");
  directory.write("bare.csv", text.substr(text.find('\n') + 1));
  expect_in(run_in(directory, {"report", "here", "--measured", "bare.csv", "--shift", "1.2345ms",
                               "--low-pass", "20kHz", "--units", "us,kN"})
                .output,
            "1234.5 us", "20 kHz", "as given");
}

TEST_F(ReportWithMeasurement, PassesOnHowTheFileIsRead) {
  std::string text = directory.read("force.csv");
  directory.write("bare.csv", text.substr(text.find('\n') + 1));
  expect_in(run_in(directory, {"report", "here", "--measured", "bare.csv", "--units", "us,kN",
                               "--gain", "find"})
                .output,
            "gain", "1.01", "found");
}

TEST_F(ReportWithMeasurement, RefusesWithWhatIsAllowed) {
  const auto refusal = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"report", "here"});
    const Finished finished = run_in(directory, options, 2);
    return finished.errors;
  };
  directory.write("without.csv", "time,force\n0,1\n");
  expect_in(refusal({"--measured", "without.csv"}), "without.csv:1: states no unit of time",
            "units=us,N");
  expect_in(refusal({"--shift", "1us"}), "--measured");
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
