// Error bars of runs on mixed cells.

#include "paper_run.h"
#include "subimpact/case/simulate.h"
#include "subimpact/study/judgement.h"
#include "subimpact/study/run_as_asked.h"
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

TEST(MixedCells, HaveNoErrorOfTimeAlone) {
  EXPECT_TRUE(cases_beside_in_time(mixed_case()).empty());
  RunRequest request;
  request.error_bars = ErrorBars::time;
  EXPECT_THROW(run_as_asked(mixed_case(), {}, std::move(request)), InvalidCase);
}

}  // namespace
}  // namespace subimpact
