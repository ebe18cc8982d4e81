#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include <nlohmann/json.hpp>

#include "process.h"

namespace subimpact {
namespace {

void expect_in(const std::string& text, const std::string& piece) {
  EXPECT_NE(text.find(piece), std::string::npos) << '"' << piece << "\" is not in:\n" << text;
}

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
  const Finished finished = run_program(
      of_paper("sensitivity", {"--by", "striker.velocity,beam.thickness", "--out", "s"}),
      directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  for (const char* piece : {"us per 1 %", "striker.", "velocity", "218.94", "sensitivity.csv in s",
                            "at rtol 1e-13 in place of 1e-08"}) {
    expect_in(finished.output, piece);
  }
  std::istringstream csv(read_file(directory.path / "s" / "sensitivity.csv"));
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
  const Finished finished =
      run_program(of_paper("sensitivity", {"--by", "striker.mass"}), directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  EXPECT_TRUE(std::filesystem::is_empty(directory.path));
}

TEST(SensitivityCommand, ChoosesTheMeshOfACaseThatLeavesItOpen) {
  const TemporaryDirectory directory;
  directory.write("open.toml",
                  "beam = { length = 0.7112, width = 0.0163, thickness = 0.0075, density = 2600, "
                  "youngs_modulus = 71.96e9 }\n"
                  "striker = { mass = 0.201, nose_radius = 0.01, velocity = 15.9 }\n"
                  "time = { end = 3e-4 }\n");
  const Finished finished =
      run_program({"sensitivity", "open.toml", "--by", "striker.velocity"}, directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  expect_in(finished.output, "Hermite");
}

TEST(SensitivityCommand, RefusesKeysByName) {
  const auto refused = [](const std::string& key, const std::string& piece) {
    const Finished finished = run_program(of_paper("sensitivity", {"--by", key}));
    EXPECT_EQ(finished.status, 2) << key;
    expect_in(finished.errors, piece);
  };
  refused("striker.velocty", "did you mean \"striker.velocity\"?");
  refused("striker.gap", "striker.gap");
  refused("striker.gap", "is 0, which has no logarithm");
  refused("striker.position", "is 0.5, where the scene is symmetric");
}

TEST(Run, OfACaseWithScatterStatesHowFarItCanBePredicted) {
  const TemporaryDirectory directory;
  const Finished finished = run_program(
      of_paper("run", {"--set", "scatter.striker.velocity=0.01", "--out", "r"}), directory.path);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  for (const char* piece : {"predictable", "standard deviations by the scatter of the case"}) {
    expect_in(finished.output, piece);
  }
  const auto summary = nlohmann::json::parse(read_file(directory.path / "r" / "summary.json"));
  // 1.654 us by ln v.
  EXPECT_NEAR(summary.at("predictability").at("zones").at(0).at("start_scatter_s"), 0.0, 1e-15);
  const std::string events = read_file(directory.path / "r" / "events.csv");
  expect_in(events.substr(0, events.find('\n')), ",start_scatter_s,end_scatter_s,");
}

TEST(Run, OfACaseWithoutScatterDoesNotSayHowFarItCanBePredicted) {
  const TemporaryDirectory directory;
  const Finished finished = run_program(of_paper("run", {"--out", "r"}), directory.path);
  EXPECT_EQ(finished.output.find("predictable"), std::string::npos);
  const auto summary = nlohmann::json::parse(read_file(directory.path / "r" / "summary.json"));
  EXPECT_TRUE(summary.at("predictability").is_null());
}

}  // namespace
}  // namespace subimpact
