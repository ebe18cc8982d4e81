// Stated errors of event times against errors known from far more accurate runs.

#include "subimpact/study/judgement.h"

#include "coverage.h"
#include "paper_run.h"
#include "subimpact/study/match.h"
#include "testing.h"

namespace subimpact {
namespace {

Result judged_in_time(const Case& input) {
  return simulate_judged(input, cases_beside_in_time(input), 2);
}

Case scene(SectionKind section, double end_time) {
  Case input = paper_run(section, end_time, 501, Method::nystrom);
  input.solver.rtol = 1e-7;
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
  Coverage coverage;
  for (const Case& input : ten_scenes()) {
    Case accurate = input;
    accurate.solver = {};
    const bool elastic = input.model.section == SectionKind::elastic;
    accurate.solver.method = elastic ? Method::exponential : Method::nystrom;
    accurate.solver.rtol = elastic ? 1e-12 : 1e-11;
    coverage.judge(judged_in_time(input), simulate(accurate));
  }
  coverage.expect(300, 20.0);
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
