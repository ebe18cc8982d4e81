// Stated errors of event times against errors known from far more accurate runs.

#include "subimpact/study/error_bars.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "paper_scene.h"
#include "subimpact/study/match.h"

namespace subimpact {
namespace {

Case scene(SectionKind section, double end_time) {
  Case input;
  input.scene = paper_scene();
  input.model.section = section;
  input.end_time = end_time;
  input.solver.method = Method::nystrom;
  input.solver.rtol = 1e-7;
  input.output.interval = 0.0;
  return input;
}

// Ten scenes unlike each other: speeds, masses, places, thicknesses, sections, methods.
std::vector<Case> ten_scenes() {
  std::vector<Case> cases(10, scene(SectionKind::exact, 2.5e-3));
  cases[0] = scene(SectionKind::elastic, 8e-3);
  cases[1].end_time = 6.5e-3;
  cases[2] = scene(SectionKind::layers, 6.3e-3);
  cases[3].scene.striker.velocity = 8.0;
  cases[3].end_time = 6e-3;
  cases[4].scene.striker.velocity = 25.0;
  cases[4].solver.method = Method::erk;
  cases[5].scene.striker.position = 0.37;
  cases[5].model.segments = 300;
  cases[5].end_time = 4e-3;
  cases[6] = scene(SectionKind::elastic, 6e-3);
  cases[6].scene.striker.mass = 0.5;
  cases[6].solver.method = Method::exponential;
  cases[7] = scene(SectionKind::elastic, 6e-3);
  cases[7].scene.beam.thickness = 0.01;
  cases[7].solver.method = Method::erk;
  cases[8] = scene(SectionKind::elastic, 4e-3);
  cases[8].solver.method = Method::central_difference;
  cases[8].solver.step = 1e-8;
  cases[9].scene.beam.theory = BeamTheory::euler_bernoulli;
  cases[9].model.segments = 201;
  cases[9].end_time = 5e-3;
  return cases;
}

TEST(StatedErrors, CoverTheTrueOnesWithoutBeingVain) {
  int n_events = 0;
  int n_covered = 0;
  std::vector<double> ratios;
  int number = 0;
  for (const Case& input : ten_scenes()) {
    const Result result = simulate_with_error_bars(input);
    Case accurate = input;
    accurate.solver = {};
    const bool elastic = input.model.section == SectionKind::elastic;
    accurate.solver.method = elastic ? Method::exponential : Method::nystrom;
    accurate.solver.rtol = elastic ? 1e-12 : 1e-11;
    const Result exact = simulate(accurate);
    const std::size_t n =
        std::min(n_leading_matches(match_sub_impacts(result.sub_impacts, exact.sub_impacts)),
                 result.error_estimate->first_unresolved.value_or(result.sub_impacts.size()));
    int covered = 0;
    int events = 0;
    const auto judge = [&](double stated, double error) {
      ++events;
      covered += error <= stated;
      if (error > 0.0) ratios.push_back(stated / error);
    };
    for (std::size_t i = 0; i < n; ++i) {
      const SubImpact& here = result.sub_impacts[i];
      const SubImpact& there = exact.sub_impacts[i];
      if (i > 0) judge(here.start_error.value(), std::abs(here.start - there.start));
      if (here.end && there.end) judge(here.end_error.value(), std::abs(*here.end - *there.end));
    }
    printf("scene %d: %zu sub-impacts, %zu decided; %d of %d times covered; largest %.1e us\n",
           ++number, result.sub_impacts.size(), n, covered, events,
           1e6 * result.error_estimate->largest_error);
    n_events += events;
    n_covered += covered;
  }
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2),
                   ratios.end());
  const double median = ratios[ratios.size() / 2];
  printf("%d of %d event times covered (%.1f %%), median stated/true %.1f\n", n_covered, n_events,
         100.0 * n_covered / n_events, median);
  EXPECT_GE(n_events, 300);
  EXPECT_GE(n_covered, 0.95 * n_events);
  EXPECT_LT(median, 20.0);
  EXPECT_GT(median, 1.0);
}

TEST(ACompanion, IsMoreAccurateOrSaysThatItIsNot) {
  Case input = scene(SectionKind::elastic, 1e-4);
  EXPECT_DOUBLE_EQ(refined_run_of(input).input.solver.rtol, 1e-9);
  input.solver.rtol = 1e-13;
  const RefinedRun looser = refined_run_of(input);
  EXPECT_DOUBLE_EQ(looser.input.solver.rtol, 1e-11);
  EXPECT_NE(looser.description.find("whose errors these are"), std::string::npos);
  input.solver.method = Method::central_difference;
  EXPECT_LT(refined_run_of(input).input.solver.step.value(),
            0.51 * resolve(input).settings().step.value());
}

TEST(CoarseCentralDifferences, NameTheFirstSubImpactTheyDoNotDecide) {
  Case input = scene(SectionKind::layers, 2e-3);
  input.solver.method = Method::central_difference;
  input.solver.step = 1e-7;
  const Result result = simulate_with_error_bars(input);
  ASSERT_TRUE(result.error_estimate->first_unresolved.has_value());
  EXPECT_GE(*result.error_estimate->first_unresolved, 8u);  // the first zone's start is certain
  EXPECT_FALSE(result.error_estimate->reason.empty());
  EXPECT_EQ(result.sub_impacts.front().start_error, 0.0);
}

}  // namespace
}  // namespace subimpact
