#include <fmt/format.h>
#include <regex>

#include "process.h"

namespace subimpact {
namespace {

// A run in the folder "here", and its force as a recorder would have it: 0.25 us apart, 1 % too
// large, its clock 1234.5 us behind; in kN and us.
void make_run_and_measurement(const TemporaryDirectory& directory) {
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

TEST(ReportWithMeasurement, StatesShiftAndDifferencesAndShowsBothForces) {
  const TemporaryDirectory directory;
  make_run_and_measurement(directory);
  const Finished finished = run_in(directory, {"report", "here", "--measured", "force.csv"});
  expect_not_in(finished.errors, "warning");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(finished.output, found, std::regex("shift +([0-9.]+)")));
  EXPECT_NEAR(std::stod(found[1]), 1234.5, 0.025);
  ASSERT_TRUE(std::regex_search(finished.output, found,
                                std::regex("largest force .* measured: ([-+0-9.]+) %")));
  EXPECT_NEAR(std::stod(found[1]), -0.99, 0.06);
  ASSERT_TRUE(
      std::regex_search(finished.output, found, std::regex("impulse .* measured: ([-+0-9.]+) %")));
  EXPECT_NEAR(std::stod(found[1]), -0.99, 0.06);
  EXPECT_TRUE(directory.has("here/figures/measured.svg"));
  const std::string page = directory.read("here/report.html");
  expect_in(page, "Compared with the measurement", "figure-measured", "\"overlay\":[{");
  run_in(directory, {"report", "here"});
  expect_not_in(directory.read("here/report.html"), "Compared with the measurement");
}

TEST(ReportWithMeasurement, TakesAGivenShiftAndCutoff) {
  const TemporaryDirectory directory;
  make_run_and_measurement(directory);
  expect_in(run_in(directory, {"report", "here", "--measured", "force.csv", "--shift", "1.2345ms",
                               "--low-pass", "20kHz"})
                .output,
            "1234.5 us", "20 kHz", "as given");
}

TEST(ReportWithMeasurement, RefusesWithWhatIsAllowed) {
  const TemporaryDirectory directory;
  make_run_and_measurement(directory);
  const auto refusal = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"report", "here"});
    const Finished finished = run_in(directory, options, 2);
    return finished.errors;
  };
  directory.write("without.csv", "time,force\n0,1\n");
  expect_in(refusal({"--measured", "none.csv"}), "none.csv: cannot be read (No such");
  expect_in(refusal({"--measured", "without.csv"}), "unit of time (s, ms, us, ns)");
  expect_in(refusal({"--shift", "1us"}), "--measured");
  expect_in(refusal({"--measured", "force.csv", "--shift", "3"}), "a time with its unit");
  expect_in(refusal({"--measured", "force.csv", "--shift", "10 s"}), "no time in common");
  expect_in(refusal({"--measured", "force.csv", "--low-pass", "-2kHz"}), "a frequency above 0");
  expect_in(refusal({"here", "--measured", "force.csv", "--out", "both"}), "one run");
}

TEST(ReportWithMeasurement, WarnsOfAForceThatIsNotThatOfTheCase) {
  const TemporaryDirectory directory;
  make_run_and_measurement(directory);
  std::string hum = "time_ms,force_N\n";
  for (int i = 0; i < 1000; ++i) hum += fmt::format("{},{}\n", 1e-3 * i, std::sin(0.1 * i));
  directory.write("hum.csv", hum);
  expect_in(run_in(directory, {"report", "here", "--measured", "hum.csv"}).errors,
            "warning: the two forces have a correlation of");
}

}  // namespace
}  // namespace subimpact
