#include <nlohmann/json.hpp>

#include "process.h"

namespace subimpact {
namespace {

std::vector<std::string> of_paper(const std::string& command,
                                  const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {
      command, SUBIMPACT_PAPER_CASE,    "--method", "exponential",
      "--set", "model.section=elastic", "--set",    "time.end=3e-4"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(SensitivityCommand, WritesItsFileAndPrintsTheTable) {
  const TemporaryDirectory directory;
  expect_in(run_in(directory, of_paper("sensitivity",
                                       {"--by", "striker.velocity,beam.thickness", "--out", "s"}))
                .output,
            "us per 1 %", "striker.", "velocity", "218.94", "sensitivity.csv in s",
            "at rtol 1e-13 in place of 1e-08");
  std::istringstream csv(directory.read("s/sensitivity.csv"));
  std::string heading, start, end;
  std::getline(csv, heading);
  std::getline(csv, start);
  std::getline(csv, end);
  EXPECT_EQ(heading,
            "quantity,sub_impact,value,d_striker.velocity,error_striker.velocity,d_beam.thickness,"
            "error_beam.thickness,flag");
  EXPECT_EQ(start, "start_s,1,0,0,0,0,0,");
  expect_in(end, "end_s,1,0.00021894");
}

TEST(SensitivityCommand, WritesNothingWithoutADirectory) {
  const TemporaryDirectory directory;
  run_in(directory, of_paper("sensitivity", {"--by", "striker.mass"}));
  EXPECT_TRUE(std::filesystem::is_empty(directory.path));
}

TEST(SensitivityCommand, ChoosesTheMeshOfACaseThatLeavesItOpen) {
  const TemporaryDirectory directory;
  directory.write("open.toml",
                  "beam = { length = 0.7112, width = 0.0163, thickness = 0.0075, density = 2600, "
                  "youngs_modulus = 71.96e9 }\n"
                  "striker = { mass = 0.201, nose_radius = 0.01, velocity = 15.9 }\n"
                  "time = { end = 3e-4 }\n");
  expect_in(run_in(directory, {"sensitivity", "open.toml", "--by", "striker.velocity"}).output,
            "Hermite");
}

TEST(SensitivityCommand, RefusesKeysByName) {
  const auto refused = [](const std::string& key, const std::string& piece) {
    expect_in(run_anywhere(of_paper("sensitivity", {"--by", key}), 2).errors, piece);
  };
  refused("striker.velocty", "did you mean \"striker.velocity\"?");
  refused("striker.gap", "striker.gap");
  refused("striker.gap", "is 0, which has no logarithm");
  refused("striker.position", "is 0.5, where the scene is symmetric");
}

TEST(Run, OfACaseWithScatterStatesHowFarItCanBePredicted) {
  const TemporaryDirectory directory;
  expect_in(
      run_in(directory, of_paper("run", {"--set", "scatter.striker.velocity=0.01", "--out", "r"}))
          .output,
      "predictable", "standard deviations by the scatter of the case");
  const auto summary = nlohmann::json::parse(directory.read("r/summary.json"));
  // 1.654 us by ln v.
  EXPECT_NEAR(summary.at("predictability").at("zones").at(0).at("start_scatter_s"), 0.0, 1e-15);
  const std::string events = directory.read("r/events.csv");
  expect_in(events.substr(0, events.find('\n')), ",start_scatter_s,end_scatter_s,");
}

TEST(Run, OfACaseWithoutScatterDoesNotSayHowFarItCanBePredicted) {
  const TemporaryDirectory directory;
  expect_not_in(run_program(of_paper("run", {"--out", "r"}), directory.path).output, "predictable");
  const auto summary = nlohmann::json::parse(directory.read("r/summary.json"));
  EXPECT_TRUE(summary.at("predictability").is_null());
}

}  // namespace
}  // namespace subimpact
