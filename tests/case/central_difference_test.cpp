// The paper's scheme: what it gets right, where it is refused and how it fails.

#include "paper_case.h"

namespace subimpact {
namespace {

Case central(SectionKind section, double end_time) {
  Case input = paper_case(section, end_time);
  input.solver.method = Method::central_difference;
  return input;
}

TEST(CentralDifferencesAtATenthOfAMicrosecond, FindTheFirstNineSubImpactsOfLayers) {
  Case input = central(SectionKind::layers, 1e-3);
  input.solver.step = 1e-7;
  const Result result = simulate(input);
  const auto reference = reference_table("seed_layers40");
  // The ninth begins after 1 ms; eight end before it.
  input.end_time = 1.42e-3;
  const Result longer = simulate(input);
  ASSERT_GE(longer.sub_impacts.size(), 9u);
  double worst = 0.0;
  for (std::size_t i = 0; i < 9; ++i) {
    worst = std::max({worst, std::abs(start_us(longer.sub_impacts[i]) - reference[i].start_us),
                      std::abs(end_us(longer.sub_impacts[i]) - reference[i].end_us)});
  }
  printf("largest difference of the first nine %.3f us (bound 1.5)\n", worst);
  EXPECT_LT(worst, 1.5);
  EXPECT_EQ(result.sub_impacts.size(), 8u);
}

TEST(CentralDifferences, ConvergeAtSecondOrderOnTheElasticBeam) {
  const double reference = reference_table("seed_elastic").front().end_us;
  double previous = 0.0;
  for (const double step : {4e-8, 2e-8, 1e-8}) {
    Case input = central(SectionKind::elastic, 0.23e-3);
    input.solver.step = step;
    const double error = std::abs(end_us(simulate(input).sub_impacts.front()) - reference);
    const double order = previous > 0.0 ? std::log2(previous / error) : 2.0;
    printf("step %5.1f ns: error of the first separation %.3e us, order %.2f\n", 1e9 * step, error,
           order);
    EXPECT_GT(order, 1.6);
    EXPECT_LT(order, 2.4);
    previous = error;
  }
}

TEST(AStepOnePercentBeyondCritical, IsRefusedNamingTheLimit) {
  Case input = central(SectionKind::elastic, 1e-4);
  const double critical = resolve(input).settings().critical_step;
  EXPECT_NEAR(critical, 2.0 / 7.043e6, 1e-10);
  input.solver.step = 1.01 * critical;
  const Refusal refusal = refusal_of(input);
  EXPECT_EQ(refusal.key, "solver.step");
  expect_in(refusal.message, "0.283");
}

class ForcedBeyondCritical : public testing::TestWithParam<SectionKind> {};

TEST_P(ForcedBeyondCritical, TheBlowUpIsDetectedAndResultsAreKept) {
  Case input = central(GetParam(), 2e-3);
  input.solver.step = 1.01 * resolve(input).settings().critical_step;
  input.study.beyond_critical = true;
  const Result result = simulate(input);
  printf("stopped at %.1f us: %s\n", 1e6 * result.outcome.time, result.outcome.message.c_str());
  EXPECT_EQ(result.outcome.kind, OutcomeKind::unstable);
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

TEST(EventsLocatedInsteadOfInterpolated, LeaveTheSchemeAtSecondOrder) {
  const double reference = reference_table("seed_elastic").front().end_us;
  double previous = 0.0;
  for (const double step : {4e-8, 2e-8, 1e-8}) {
    Case input = central(SectionKind::elastic, 0.23e-3);
    input.solver.step = step;
    input.solver.events = EventHandling::located;
    const double error = std::abs(end_us(simulate(input).sub_impacts.front()) - reference);
    const double order = previous > 0.0 ? std::log2(previous / error) : 2.0;
    printf("step %5.1f ns: error %.3e us, order %.2f\n", 1e9 * step, error, order);
    EXPECT_GT(order, 1.8);
    EXPECT_LT(order, 2.2);
    previous = error;
  }
}

}  // namespace
}  // namespace subimpact
