#include "subimpact/study/plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "elastic_case.h"
#include "print.h"

namespace subimpact {
namespace {

// 218.049244 us and 275.925801 us: the limit of an independent program (tests/data).
TEST(TheLimitOfFineMeshes, IsThatOfAnIndependentProgramWithinItsUncertainty) {
  const MeshLimit limit = mesh_limit(elastic_case(285e-6), 1e-8);
  ASSERT_EQ(limit.sub_impacts.size(), 3u);
  EXPECT_NEAR(1e6 * *limit.sub_impacts[0].end, 218.049244, 1e-4);
  EXPECT_NEAR(1e6 * *limit.sub_impacts[2].end, 275.925801, 1e-3);
  ASSERT_EQ(limit.first_end.size(), 2u);
  const FirstEndLimit& cells = limit.first_end[0];
  EXPECT_GT(cells.order, 1.8);
  EXPECT_LT(cells.order, 2.2);
  EXPECT_LT(std::abs(1e6 * cells.value - 218.049244), 1e6 * cells.uncertainty);
  EXPECT_LT(1e6 * cells.uncertainty, 0.05);
  const FirstEndLimit& elements = limit.first_end[1];
  EXPECT_GT(elements.order, 3.6);
  EXPECT_LT(elements.order, 4.4);
  EXPECT_LT(std::abs(1e6 * elements.value - 218.049244), 1e-4 + 1e6 * elements.uncertainty);
}

TEST(APlan, NamesACombinationWhoseTotalErrorIsWithinTheWantedOne) {
  const double wanted = 1e-6;
  const Plan result = plan(elastic_case(285e-6), wanted);
  ASSERT_TRUE(result.cheapest.has_value());
  const PlanPoint& best = result.points[*result.cheapest];
  EXPECT_EQ(best.run.verdict, Verdict::right);
  EXPECT_LE(best.run.errors.maximum, wanted);
  for (const PlanPoint& point : result.points) EXPECT_LE(point.mesh_error, wanted);
  // 501 cells are 1.1 us off whatever the method.
  for (const PlanPoint& point : result.points) EXPECT_NE(point.mesh, "501 cells");
  // The named combination, run as anyone would, is within the error of the limit.
  Case again = with_setting(best.input, best.run.setting);
  again.end_time = result.limit.horizon;
  const EventErrors errors = event_errors(simulate(again).sub_impacts, result.limit.sub_impacts);
  EXPECT_LE(errors.maximum, wanted);
}

TEST(APlan, IsNotMadeWhereNoLimitIsKnown) {
  EXPECT_THROW(plan(elastic_case(1e-4), 1e-6), InvalidCase);
}

}  // namespace
}  // namespace subimpact
