#include "subimpact/study/plan.h"

#include "elastic_case.h"
#include "testing.h"

namespace subimpact {
namespace {

// 218.049244 us and 275.925801 us: the limit of an independent program (tests/data).
TEST(APlan, IsJudgedByTheLimitOfAnIndependentProgram) {
  const Plan result = plan(elastic_case(285e-6), 0.1e-6);
  ASSERT_EQ(result.reference.sub_impacts.size(), 3u);
  EXPECT_NEAR(1e6 * *result.reference.sub_impacts[0].end, 218.049244, 0.02);
  EXPECT_NEAR(1e6 * *result.reference.sub_impacts[2].end, 275.925801, 0.02);
  EXPECT_LE(result.reference.error, 0.2 * 0.1e-6);
}

TEST(APlan, NamesTheCheapestMeshThatIsWithinTheErrorTogetherWithAllFinerOnes) {
  const double wanted = 1e-6;
  const Plan result = plan(elastic_case(285e-6), wanted);
  ASSERT_TRUE(result.cheapest.has_value());
  const PlanPoint& best = result.points[*result.cheapest];
  EXPECT_EQ(best.verdict, Verdict::right);
  EXPECT_TRUE(best.admitted);
  EXPECT_LE(best.errors.maximum, wanted);
  bool admitted = false;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const PlanPoint& point = result.points[i];
    const PlanPoint* before = i > 0 ? &result.points[i - 1] : nullptr;
    const bool same =
        before && before->setting.method == point.setting.method &&
        before->input.model.strike_refinement == point.input.model.strike_refinement &&
        before->input.model.mesh == point.input.model.mesh;
    EXPECT_FALSE(same && admitted && !point.admitted) << point.mesh;
    admitted = point.admitted;
    if (admitted) {
      EXPECT_GE(point.counted, best.counted);
    }
  }
  // The named combination, run as anyone would, is within the error of the reference.
  const EventErrors errors =
      event_errors(simulate(best.input).sub_impacts, result.reference.sub_impacts);
  EXPECT_LE(errors.maximum, wanted);
}

// Separations last 6.5 and 7.1 us.
TEST(APlan, AdvisesNoErrorThatSubImpactsGetLostIn) {
  const Plan result = plan(elastic_case(285e-6), 20e-6);
  ASSERT_TRUE(result.cheapest.has_value());
  double shortest = INFINITY;
  for (std::size_t i = 1; i < result.reference.sub_impacts.size(); ++i) {
    shortest = std::min(
        shortest, result.reference.sub_impacts[i].start - *result.reference.sub_impacts[i - 1].end);
  }
  EXPECT_LE(result.points[*result.cheapest].errors.maximum, 0.5 * shortest);
}

TEST(APlan, IsNotMadeWhereNoEventTimeIsKnown) {
  EXPECT_THROW(plan(elastic_case(1e-4), 1e-6), InvalidCase);
}

TEST(EventErrors, CallAContactStillOpenWrongWhereThatOfTheReferenceHasEnded) {
  SubImpact ended;
  ended.end = 1e-4;
  SubImpact open;
  const EventErrors errors = event_errors({open}, {ended});
  EXPECT_FALSE(errors.all_correspond());
}

}  // namespace
}  // namespace subimpact
