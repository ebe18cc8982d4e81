// Stated errors of event times against errors known from far more accurate runs.

#include "subimpact/study/judgement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "paper_scene.h"
#include "subimpact/study/match.h"

namespace subimpact {
namespace {

Result judged_in_time(const Case& input) {
  return simulate_judged(input, cases_beside_in_time(input), 2);
}

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
    const Result result = judged_in_time(input);
    Case accurate = input;
    accurate.solver = {};
    const bool elastic = input.model.section == SectionKind::elastic;
    accurate.solver.method = elastic ? Method::exponential : Method::nystrom;
    accurate.solver.rtol = elastic ? 1e-12 : 1e-11;
    const Result exact = simulate(accurate);
    int covered = 0;
    int events = 0;
    const auto judge = [&](double stated, double error) {
      ++events;
      covered += error <= stated;
      if (error > 0.0) ratios.push_back(stated / error);
    };
    const Counterparts exact_ones = counterparts(result.sub_impacts, exact.sub_impacts);
    for (std::size_t i = 0; i < result.sub_impacts.size(); ++i) {
      const SubImpact& here = result.sub_impacts[i];
      if (!*here.certain) continue;
      ASSERT_TRUE(exact_ones.of[i]) << i;
      const SubImpact& there = *exact_ones.of[i];
      if (i > 0) judge(here.start_error.value(), std::abs(here.start - there.start));
      if (here.end && there.end) judge(here.end_error.value(), std::abs(*here.end - *there.end));
    }
    printf("scene %d: %zu sub-impacts, %zu certain; %d of %d times covered; largest %.1e us\n",
           ++number, result.sub_impacts.size(), *result.n_certain(), covered, events,
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

TEST(CasesBesideInTime, DifferInStepOrToleranceAlone) {
  Case input = scene(SectionKind::elastic, 1e-4);
  EXPECT_DOUBLE_EQ(cases_beside_in_time(input).at(0).input.solver.rtol, 1e-6);
  EXPECT_EQ(cases_beside_in_time(input).at(0).input.model.segments, input.model.segments);
  input.solver.method = Method::central_difference;
  EXPECT_LT(cases_beside_in_time(input).at(0).input.solver.step.value(),
            0.71 * resolve(input).settings().step.value());
}

TEST(CoarseCentralDifferences, NameTheFirstSubImpactTheyAreNotCertainOf) {
  Case input = scene(SectionKind::layers, 2e-3);
  input.solver.method = Method::central_difference;
  input.solver.step = 1e-7;
  const Result result = judged_in_time(input);
  ASSERT_TRUE(result.error_estimate->first_unresolved.has_value());
  EXPECT_GE(*result.error_estimate->first_unresolved, 8u);  // the first zone's start is certain
  EXPECT_FALSE(result.error_estimate->reason.empty());
  EXPECT_EQ(result.sub_impacts.front().start_error, 0.0);
}

}  // namespace
}  // namespace subimpact
