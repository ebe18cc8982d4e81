// The paper's scheme: what it gets right, where it is refused and how it fails.

#include "order_table.h"
#include "paper_case.h"

namespace subimpact {
namespace {

Case central(SectionKind section, double end_time) {
  return paper_case(section, end_time, 501, Method::central_difference);
}

void expect_second_order(std::optional<EventHandling> events, double band) {
  const double reference = reference_table("seed_elastic").front().end_us;
  OrderTable table("error of the first separation, us, over steps per us");
  for (const double step : {4e-8, 2e-8, 1e-8}) {
    Case input = central(SectionKind::elastic, 0.23e-3);
    input.solver.step = step;
    input.solver.events = events;
    table.add(1e-6 / step, std::abs(end_us(simulate(input).sub_impacts.front()) - reference));
  }
  table.expect_every_order_within(2.0 - band, 2.0 + band);
}

TEST(CentralDifferences, ConvergeAtSecondOrderOnTheElasticBeam) {
  expect_second_order(std::nullopt, 0.4);
}

TEST(EventsLocatedInsteadOfInterpolated, LeaveTheSchemeAtSecondOrder) {
  expect_second_order(EventHandling::located, 0.2);
}

TEST(AStepOnePercentBeyondCritical, IsRefusedNamingTheLimit) {
  Case input = central(SectionKind::elastic, 1e-4);
  const double critical = resolve(input).settings().critical_step;
  EXPECT_NEAR(critical, 2.0 / 7.043e6, 1e-10);
  input.solver.step = 1.01 * critical;
  expect_refused(input, "solver.step", "0.283");
}

class ForcedBeyondCritical : public testing::TestWithParam<SectionKind> {};

TEST_P(ForcedBeyondCritical, TheBlowUpIsDetectedAndResultsAreKept) {
  Case input = central(GetParam(), 2e-3);
  input.solver.step = 1.01 * resolve(input).settings().critical_step;
  input.study.beyond_critical = true;
  const Result result = simulate(input);
  EXPECT_EQ(result.outcome.kind, OutcomeKind::unstable) << result.outcome.message;
  EXPECT_LT(result.outcome.time, 2e-3);
  EXPECT_GE(result.sub_impacts.size(), 1u);
}

TEST_P(ForcedBeyondCritical, JustBelowItIsStable) {
  Case input = central(GetParam(), 2e-3);
  input.solver.step = 0.99 * resolve(input).settings().critical_step;
  EXPECT_TRUE(simulate(input).outcome.completed());
}

INSTANTIATE_TEST_SUITE_P(, ForcedBeyondCritical,
                         testing::Values(SectionKind::elastic, SectionKind::exact,
                                         SectionKind::layers),
                         NamedAsPrinted{});

TEST(WithoutRotaryInertia, TheCriticalStepIsTheEulerBernoulliGrids) {
  Case input = central(SectionKind::elastic, 1e-4);
  input.scene.beam.theory = BeamTheory::euler_bernoulli;
  EXPECT_NEAR(1e6 * resolve(input).settings().critical_step, 0.0885, 5e-5);
  input.solver.step = 1e-7;  // the paper's own step
  EXPECT_THROW(simulate(input), InvalidCase);
}

}  // namespace
}  // namespace subimpact
