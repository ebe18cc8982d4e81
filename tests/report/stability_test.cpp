#include "subimpact/report/studies.h"

#include <fmt/format.h>

#include "temporary_directory.h"
#include "testing.h"

namespace subimpact {
namespace {

TEST(StabilityFigures, NameMethodsAndAxesOfTheirTables) {
  const TemporaryDirectory directory;
  std::vector<CriticalStep> steps;
  for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
    for (const char* method : {"central-difference", "erk:dop853"}) {
      steps.push_back({method, theory, 101, 1e7, 2.0, 2e-7, 2.01e-7});
      steps.push_back({method, theory, 201, 2e7, 2.0, 1e-7, 1.01e-7});
    }
  }
  write(directory.path, part_of(steps));
  expect_in(directory.read("critical_steps.svg"), "central-difference", "erk:dop853",
            "Euler-Bernoulli", "largest stable step");
  const std::vector<StiffContact> contact = {{1e7, 3e-7, 2e-7, 2e-7}, {1e8, 3e-7, 1e-7, 1e-7}};
  write(directory.path, part_of(contact));
  expect_in(directory.read("stiff_contact.svg"), "beam alone", "measured");
  write(directory.path, part_of({{"dirk:esdirk547", 1.0, 0.9, 0.9}, {"dirk:trbdf2", 2.0, 0.8, 0.8}},
                                {{1, 0.1, 0.99}, {1, 1.0, 0.7}, {5, 0.1, 1.0}, {5, 1.0, 1.1}}));
  expect_in(directory.read("damping.svg"), ">esdirk547<", ">trbdf2<", "order 5");
  const std::vector<MissedPairs> pairs = {{1e-6, 21, 21, 20, 2e-6}, {1e-5, 21, 21, 3, 2e-6}};
  write(directory.path, part_of(pairs));
  expect_in(directory.read("missed_pairs.svg"), "strikes (of 21) wholly found", "ends of steps");
  LayerStudy layers;
  layers.points = {{10, {}}, {20, {}}};
  for (LayerPoint& p : layers.points) p.errors.maximum = p.errors.median = 1e-6 / p.layers;
  write(directory.path, part_of(layers));
  expect_in(directory.read("layers.svg"), "layers − exact (µs)", "lost or invented");
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
    write(directory.path, part_of(steps));
    expect_in(directory.read("critical_steps.svg"), fmt::format(">{}<", segments),
              fmt::format(">{}<", 2 * segments - 1));
  }
}

TEST(AMapOfOutcomes, HasARowPerMethodAndAColumnPerSetting) {
  const TemporaryDirectory directory;
  OutcomeMap map;
  const auto add = [&](const char* group, const char* row, double x, Verdict verdict) {
    OutcomePoint& point = map.points.emplace_back();
    point.group = group;
    point.row = row;
    point.x = x;
    point.verdict = verdict;
  };
  add("fixed step", "central-difference, forced", 0.5, Verdict::right);
  add("fixed step", "central-difference, forced", 64.0, Verdict::unstable);
  add("tolerance", "bdf, order up to 2", 1e-8, Verdict::wrong_count);
  write(directory.path, part_of(map));
  expect_in(directory.read("outcomes.svg"), "central-difference, forced", "bdf, order up to 2",
            ">64<", "1e-08", "wrong count");
}

}  // namespace
}  // namespace subimpact
