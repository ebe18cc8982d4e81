#include "subimpact/report/studies.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "temporary_directory.h"

namespace subimpact {
namespace {

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void expect_in(const std::filesystem::path& path, const std::vector<std::string>& pieces) {
  const std::string text = content(path);
  for (const std::string& piece : pieces) {
    EXPECT_NE(text.find(piece), std::string::npos) << piece << " is not in " << path;
  }
}

TEST(StabilityFigures, NameMethodsAndAxesOfTheirTables) {
  const TemporaryDirectory directory;
  std::vector<CriticalStep> steps;
  for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
    for (const char* method : {"central-difference", "erk:dop853"}) {
      steps.push_back({method, theory, 101, 1e7, 2.0, 2e-7, 2.01e-7});
      steps.push_back({method, theory, 201, 2e7, 2.0, 1e-7, 1.01e-7});
    }
  }
  write_critical_steps(directory.path, steps);
  expect_in(directory.path / "critical_steps.svg",
            {"central-difference", "erk:dop853", "Euler-Bernoulli", "largest stable step"});
  write_stiff_contact(directory.path, {{1e7, 3e-7, 2e-7, 2e-7}, {1e8, 3e-7, 1e-7, 1e-7}});
  expect_in(directory.path / "stiff_contact.svg", {"beam alone", "measured"});
  write_damping(directory.path, {{"dirk:esdirk547", 1.0, 0.9, 0.9}, {"dirk:trbdf2", 2.0, 0.8, 0.8}},
                {{1, 0.1, 0.99}, {1, 1.0, 0.7}, {5, 0.1, 1.0}, {5, 1.0, 1.1}});
  expect_in(directory.path / "damping.svg", {">esdirk547<", ">trbdf2<", "order 5"});
  write_missed_pairs(directory.path, {{1e-6, 21, 21, 20, 2e-6}, {1e-5, 21, 21, 3, 2e-6}});
  expect_in(directory.path / "missed_pairs.svg", {"strikes (of 21) wholly found", "ends of steps"});
  LayerStudy layers;
  layers.points = {{10, {}}, {20, {}}};
  for (LayerPoint& p : layers.points) p.errors.maximum = p.errors.median = 1e-6 / p.layers;
  write_layers(directory.path, layers);
  expect_in(directory.path / "layers.svg", {"layers − exact (µs)", "lost or invented"});
}

TEST(TheFigureOfCriticalSteps, ShowsWhateverNumbersOfCellsThereAre) {
  for (const int segments : {9, 1601}) {
    const TemporaryDirectory directory;
    std::vector<CriticalStep> steps;
    for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
      for (const int n : {segments, segments, 2 * segments - 1}) {  // as coarse meshes have them
        steps.push_back({"central-difference", theory, n, 1e7, 2.0, 2e-5 / n, 2e-5 / n});
      }
    }
    write_critical_steps(directory.path, steps);
    expect_in(directory.path / "critical_steps.svg",
              {">" + std::to_string(segments) + "<", ">" + std::to_string(2 * segments - 1) + "<"});
  }
}

TEST(AMapOfOutcomes, HasARowPerMethodAndAColumnPerSetting) {
  const TemporaryDirectory directory;
  OutcomeMap map;
  map.points = {
      {"fixed step", "central-difference, forced", 0.5, Verdict::right, {}, 0.0, ""},
      {"fixed step", "central-difference, forced", 64.0, Verdict::unstable, {}, 0.0, ""},
      {"tolerance", "bdf, order up to 2", 1e-8, Verdict::wrong_count, {}, 0.0, "two, lost"}};
  write_outcomes(directory.path, map);
  expect_in(directory.path / "outcomes.svg",
            {"central-difference, forced", "bdf, order up to 2", ">64<", "1e-08", "wrong count"});
}

}  // namespace
}  // namespace subimpact
