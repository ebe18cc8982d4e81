// Near misses of whole runs, and what they leave undecided.

#include "paper_run.h"
#include "subimpact/study/judgement.h"
#include "subimpact/study/match.h"
#include "subimpact/study/other_mesh.h"
#include "testing.h"

namespace subimpact {
namespace {

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

TEST(NearMissesOfThePaper, On501CellsTheContactStaysSome21NanometresFromOpeningAt203us) {
  // The paper's scheme, but for the update of its striker.
  Case input = paper_case(Method::central_difference, 501);
  input.model.section = SectionKind::layers;
  input.solver.step = 1e-7;
  const NearMiss graze = nearest_to(203.2e-6, NearMissKind::opening, simulate(input));
  printf("%.3f us, %.4f um\n", 1e6 * graze.time, 1e6 * graze.margin);
  EXPECT_NEAR(graze.time, 203.2e-6, 0.1e-6);
  EXPECT_NEAR(graze.margin, 0.021e-6, 0.002e-6);
}

TEST(NearMissesOfThePaper, AreTheSameByMethodsWithAndWithoutLongSteps) {
  const Result result = simulate(paper_case(Method::nystrom, 501));
  const NearMiss graze = nearest_to(203.2e-6, NearMissKind::opening, result);
  for (const Method method : {Method::erk, Method::exponential, Method::central_difference}) {
    Case input = paper_case(method, 501);
    if (method == Method::central_difference) input.solver.step = 1e-8;
    const Result other = simulate(input);
    const NearMiss same = nearest_to(203.2e-6, NearMissKind::opening, other);
    printf("%.4f us, %.5f um\n", 1e6 * same.time, 1e6 * same.margin);
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
  printf("%.4f us, %.5f um\n", 1e6 * found.time, 1e6 * found.margin);
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

}  // namespace
}  // namespace subimpact
