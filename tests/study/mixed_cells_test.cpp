// Error bars of runs on mixed cells.

#include "paper_run.h"
#include "subimpact/case/simulate.h"
#include "subimpact/study/judgement.h"
#include "subimpact/study/run_as_asked.h"
#include "subimpact/study/sensitivity.h"
#include "testing.h"

namespace subimpact {
namespace {

Case mixed_case() {
  Case input = paper_run(SectionKind::exact, 0.4e-3, 400, Method::central_difference);
  input.model.mesh = MeshKind::mixed;
  return input;
}

TEST(MixedCells, AreJudgedByCoarserMixedCellsAtTheirOwnSteps) {
  const Case input = mixed_case();
  const std::vector<CaseBeside> beside = cases_beside_on_given_mesh(input);
  ASSERT_EQ(beside.size(), 3u);
  for (const CaseBeside& other : beside) {
    EXPECT_EQ(other.input.model.mesh, MeshKind::mixed);
    EXPECT_LT(other.input.model.segments, 400);
    EXPECT_FALSE(other.input.solver.step);
  }
  const Result result = simulate_judged(input, beside, 1);
  ASSERT_TRUE(result.outcome.completed());
  ASSERT_TRUE(result.error_estimate);
  EXPECT_GT(result.error_estimate->largest_error, 0.0);
  EXPECT_LT(result.error_estimate->largest_error, 1e-6);
}

// Errors of neighbouring meshes are alike: of order 2 they would be taken for a third of that
// difference, and fewer than two in three of a long strike's times would be covered.
TEST(MixedCells, AreOffByTheWholeDifferenceToHalfAsManyWhereTheyYield) {
  Case input = mixed_case();
  EXPECT_NEAR(cases_beside(input).back().gain, 1.0, 1e-12);
  EXPECT_LT(cases_beside(input).front().gain, 1.0);
  input.model.section = SectionKind::elastic;
  EXPECT_NEAR(cases_beside(input).back().gain, 1.0 / 3.0, 1e-12);
}

// A stiff contact: coarser meshes, whose natural steps are longer, are refused.
TEST(MixedCells, HaveNothingBesideThemThatIsRefused) {
  Case input = mixed_case();
  input.scene.contact = {ContactKind::hertz, 1e12, {}, {}, {}};
  Case coarser = input;
  coarser.model.segments = 200;
  EXPECT_THROW(resolve(coarser), InvalidCase);
  const std::vector<CaseBeside> beside = cases_beside_on_given_mesh(input);
  EXPECT_GE(beside.size(), 2u);
  for (const CaseBeside& other : beside) EXPECT_NO_THROW(resolve(other.input));
}

TEST(MixedCells, HaveAnErrorOfTimeFromAShorterStep) {
  const std::vector<CaseBeside> beside = cases_beside_in_time(mixed_case());
  ASSERT_EQ(beside.size(), 1u);
  EXPECT_LT(*beside.front().input.solver.step, *resolve(mixed_case()).settings().step);
  RunRequest request;
  request.error_bars = ErrorBars::time;
  const WithinRun run = run_as_asked(mixed_case(), {}, std::move(request));
  ASSERT_TRUE(run.result.error_estimate);
  EXPECT_GT(run.result.error_estimate->largest_error, 0.0);
  EXPECT_LT(run.result.error_estimate->largest_error, 0.5e-6);
}

TEST(MixedCells, AreJudgedWithTheStepThatACaseGives) {
  Case input = mixed_case();
  input.solver.step = 0.5 * *resolve(input).settings().step;
  for (const CaseBeside& other : cases_beside_on_given_mesh(input)) {
    EXPECT_NO_THROW(resolve(other.input)) << other.description;
  }
}

TEST(MixedCells, HaveDerivativesWhileTheBeamStaysElastic) {
  Case input = mixed_case();
  EXPECT_THROW(sensitivity_case(input), InvalidCase);
  input.model.section = SectionKind::elastic;
  EXPECT_EQ(sensitivity_case(input).solver.method, Method::nystrom);
}

}  // namespace
}  // namespace subimpact
