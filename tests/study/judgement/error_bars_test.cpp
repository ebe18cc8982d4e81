// Stated errors of event times against errors known from far more accurate runs.

#include "judgement/coverage.h"
#include "model/mesh/modes.h"
#include "paper_run.h"
#include "study/judgement/mesh_resolution.h"
#include "subimpact/study/judgement/judgement.h"

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

// Scenes unlike each other: speeds, masses, places, sections, methods.
std::vector<Case> scenes() {
  std::vector<Case> cases(6, scene(SectionKind::exact, 2.5e-3));
  cases[0] = scene(SectionKind::layers, 4e-3);
  cases[1].scene.striker.velocity = 25.0;
  cases[1].solver.method = Method::erk;
  cases[2].scene.striker.position = 0.37;
  cases[2].model.segments = 300;
  cases[3] = scene(SectionKind::elastic, 5e-3);
  cases[3].scene.striker.mass = 0.5;
  cases[3].solver.method = Method::exponential;
  cases[4] = scene(SectionKind::elastic, 3e-3);
  cases[4].solver.method = Method::central_difference;
  cases[4].solver.step = 1e-8;
  cases[5].scene.beam.theory = BeamTheory::euler_bernoulli;
  cases[5].model.segments = 201;
  return cases;
}

TEST(StatedErrors, CoverTheTrueOnesWithoutBeingVain) {
  Coverage coverage;
  for (const Case& input : scenes()) {
    Case accurate = input;
    accurate.solver = {};
    const bool elastic = input.model.section == SectionKind::elastic;
    accurate.solver.method = elastic ? Method::exponential : Method::nystrom;
    accurate.solver.rtol = elastic ? 1e-12 : 1e-11;
    coverage.judge(judged_in_time(input), simulate(accurate));
  }
  coverage.expect(160, 20.0);
}

TEST(CoarseCentralDifferences, NameTheFirstSubImpactTheyAreNotCertainOf) {
  Case input = scene(SectionKind::layers, 2e-3);
  input.solver.method = Method::central_difference;
  input.solver.step = 1e-7;
  const Result result = judged_in_time(input);
  ASSERT_TRUE(result.error_estimate->first_unresolved.has_value());
  EXPECT_GE(*result.error_estimate->first_unresolved, 8u);  // the first zone's start is certain
  EXPECT_TRUE(result.error_estimate->reason);
  EXPECT_EQ(result.sub_impacts.front().start_error, 0.0);
}

// Near misses of whole runs, and what they leave undecided.

Case paper_case(Method method, int segments) {
  return paper_run(SectionKind::exact, 0.3e-3, segments, method);
}

// The near miss of this kind closest to a time (s).
NearMiss nearest_to(double time, NearMissKind kind, const Result& result) {
  NearMiss best{-1.0, 0.0, kind};
  for (const NearMiss& here : result.near_misses) {
    if (here.kind == kind && std::abs(here.time - time) < std::abs(best.time - time)) best = here;
  }
  return best;
}

TEST(NearMissesOfThePaper, AreTheSameByMethodsWithAndWithoutLongSteps) {
  const Result result = simulate(paper_case(Method::nystrom, 501));
  const NearMiss graze = nearest_to(203.2e-6, NearMissKind::opening, result);
  for (const Method method : {Method::erk, Method::exponential, Method::central_difference}) {
    Case input = paper_case(method, 501);
    if (method == Method::central_difference) input.solver.step = 1e-8;
    const NearMiss same = nearest_to(203.2e-6, NearMissKind::opening, simulate(input));
    EXPECT_NEAR(same.time, graze.time, 2e-9);
    EXPECT_NEAR(same.margin, graze.margin, 0.01 * graze.margin);
  }
}

// Where sections may yield but do not, `exponential` passes intervals without events in one step,
// within which it keeps the nearest of the near misses.
TEST(NearMissesWithinStepsWithoutEvents, AreThoseOfAMethodOfShortSteps) {
  Case input = paper_case(Method::nystrom, 201);
  input.scene.beam.yield_stress = 1e10;
  input.scene.striker.mass = 0.2;
  input.scene.striker.velocity = 5.0;
  input.end_time = 8e-3;
  constexpr double time = 6386.0e-6;
  const NearMiss expected = nearest_to(time, NearMissKind::closing, simulate(input));
  input.solver.method = Method::exponential;
  const Result flown = simulate(input);
  const NearMiss found = nearest_to(time, NearMissKind::closing, flown);
  EXPECT_EQ(flown.n_yielded_sections, 0u);
  EXPECT_NEAR(expected.time, time, 1e-6);
  EXPECT_NEAR(found.time, expected.time, 0.2e-6);
  EXPECT_NEAR(found.margin, expected.margin, 0.01 * expected.margin);
}

TEST(NearMissesOfThePaper, LeaveTheFirstContactUncertainThoughCoarserMeshesAgree) {
  const Case input = paper_case(Method::central_difference, 501);
  // All keep the first contact closed, which finer meshes split in two.
  const Result result = simulate_judged(input, cases_beside(input), 2);
  EXPECT_NEAR(*result.sub_impacts[0].end, 217e-6, 1e-6);
  EXPECT_FALSE(*result.sub_impacts[0].certain);
  EXPECT_EQ(result.error_estimate->first_unresolved, 0u);
}

// The first-order part of the error of cells with free ends.

// A thick beam, whose second-order error is small from some 1000 cells on.
Case thick_case(int segments) {
  Case input = paper_run(SectionKind::elastic, 0.52e-3, segments, Method::central_difference);
  input.scene.beam.thickness = 0.03;
  input.scene.striker.mass = 1.0;
  return input;
}

// Modes of fine cells beside those of the continuum: the difference is the first-order part.
TEST(CellsWithFreeEnds, RaiseFrequenciesAsMuchAsTheClosedFormSays) {
  Case input = thick_case(40001);
  const Beam& beam = input.scene.beam;
  const std::vector<double> exact = flexural_frequencies(beam, 24);
  const double cells = input.model.segments;
  const NaturalModes modes =
      free_cell_modes({static_cast<std::size_t>(cells), beam.length / cells, beam.mass_per_length(),
                       beam.rotary_inertia(), beam.bending_stiffness()},
                      false, 1);
  for (const std::size_t k : {5u, 10u, 20u, 23u}) {
    const double shift = modes.frequencies[k + 2] / exact[k] - 1.0;
    const double stated = free_end_error(input, 1.0 / exact[k], 1.0);
    EXPECT_NEAR(stated, shift, 0.15 * shift) << k;
  }
}

TEST(MeshErrorsOfFineCellsWithFreeEnds, CoverTheTrueOnesThoughTwoMeshesNearlyAgree) {
  Case exact = thick_case(2001);
  exact.model.mesh = MeshKind::hermite;
  exact.model.elements = 400;
  exact.solver = {};
  exact.solver.method = Method::exponential;
  exact.solver.rtol = 1e-11;
  const double truth = *simulate(exact).sub_impacts.at(0).end;
  for (const int segments : {2001, 4001}) {
    const Case input = thick_case(segments);
    const Result result = simulate_judged(input, cases_beside(input), 2);
    const double error = std::abs(*result.sub_impacts.at(0).end - truth);
    const double stated = result.sub_impacts.at(0).end_error.value();
    EXPECT_LT(error, stated) << segments;
    EXPECT_LT(stated, 20.0 * error) << segments;
  }
}

// A clamped beam with a force on it: on coarse meshes the largest moment is at the clamp, on fine
// ones under the striker, where it converges to first order alone.
TEST(TheErrorOfALargestMoment, CoversOneThatIsElsewhereOnFinerMeshes) {
  Case input = paper_run(SectionKind::elastic, 4.86975e-5, 501, Method::exponential);
  Beam& beam = input.scene.beam;
  beam.length = 0.0803751;
  beam.width = 0.00218132;
  beam.thickness = 0.00232729;
  beam.density = 4430.0;
  beam.youngs_modulus = 114e9;
  beam.yield_stress = 992.244e6;
  beam.ends = {EndSupport::clamped, EndSupport::clamped};
  beam.forces = {{0.21009, {{0.0, 5.16261}}}};
  input.scene.striker.mass = 0.000238275;
  input.scene.striker.velocity = 9.05067;
  input.scene.striker.nose_radius = 0.016213;
  input.scene.gravity = -69.817;
  input.model.mesh = MeshKind::hermite;
  input.model.elements = 60;
  input.output.interval = input.end_time / 200.0;
  const Result run = simulate_judged(input, cases_beside(input), 2);
  Case finer = input;
  finer.model.elements = 480;
  const double right = simulate(finer).peaks.moment.largest;
  const auto& totals = run.error_estimate->totals;
  const auto found = std::ranges::find(totals, RunTotal::max_moment, &NamedTotal::name);
  ASSERT_NE(found, totals.end());
  EXPECT_GT(right, 1.05 * found->total.value);
  EXPECT_LT(right - found->total.value, *found->total.error);
  EXPECT_LT(*found->total.error, 0.2 * found->total.value);
}

}  // namespace
}  // namespace subimpact
