// One scene modelled in two ways that must agree.

#include "paper_case.h"
#include "rigid_case.h"

namespace subimpact {
namespace {

void expect_same_events(const Result& a, const Result& b) {
  ASSERT_EQ(a.sub_impacts.size(), b.sub_impacts.size());
  for (std::size_t i = 0; i < a.sub_impacts.size(); ++i) {
    const SubImpact& p = a.sub_impacts[i];
    const SubImpact& q = b.sub_impacts[i];
    EXPECT_NEAR(p.start, q.start, 1e-9 * q.start) << i;
    ASSERT_EQ(p.end.has_value(), q.end.has_value());
    EXPECT_NEAR(p.end.value_or(1.0), q.end.value_or(1.0), 1e-9 * q.end.value_or(1.0)) << i;
    EXPECT_NEAR(p.max_indentation, q.max_indentation, 1e-9 * q.max_indentation) << i;
  }
}

class HalfAndWholeModel : public testing::TestWithParam<SectionKind> {};

TEST_P(HalfAndWholeModel, GiveTheSameEvents) {
  // With one fixed step, never cut for what sections do in it (whether to do so is decided by a
  // mean over the unknowns), so that the two differ by rounding alone.
  Case input = paper_case(GetParam(), 1e-3);
  input.solver.step = 1e-7;
  input.solver.rtol = 1e-2;
  const Result half = simulate(input);
  input.model.symmetry = SymmetryUse::off;
  const Result whole = simulate(input);
  EXPECT_TRUE(half.used.half_model);
  EXPECT_FALSE(whole.used.half_model);
  EXPECT_GE(half.sub_impacts.size(), 8u);
  expect_same_events(half, whole);
}

INSTANTIATE_TEST_SUITE_P(, HalfAndWholeModel,
                         testing::Values(SectionKind::elastic, SectionKind::exact,
                                         SectionKind::layers),
                         NamedAsPrinted{});

TEST(AMirroredStrike, GivesTheSameEvents) {
  Case input = paper_case(SectionKind::exact, 0.5e-3, 150);
  input.solver.step = 1e-7;
  input.scene.striker.position = 0.3;
  const Result left = simulate(input);
  input.scene.striker.position = 0.7;
  expect_same_events(left, simulate(input));
}

TEST(ManyLayers, ComeCloseToTheExactSection) {
  const Case exact = paper_case(SectionKind::exact, 0.25e-3);
  Case layers = paper_case(SectionKind::layers, 0.25e-3);
  const double limit = simulate(exact).sub_impacts.front().end.value();
  double previous = 1.0;
  for (const int n : {20, 40, 80, 160}) {
    layers.model.layers = n;
    const double difference = std::abs(simulate(layers).sub_impacts.front().end.value() - limit);
    EXPECT_LT(difference, 0.5 * previous) << n << " layers";
    previous = difference;
  }
}

TEST(AnEvenNumberOfSegments, IsRefusedForTheHalfModelAndTakenForTheWhole) {
  Case input = paper_case(SectionKind::elastic, 1e-5, 100);
  expect_refused(input, "model.segments", "101");
  input.model.symmetry = SymmetryUse::off;
  EXPECT_TRUE(simulate(input).outcome.completed());
}

TEST(AnIndentationAsDeepAsTheBeam, EndsTheRunWithWhatWasComputed) {
  Case input = paper_case(SectionKind::elastic, 1e-3);
  input.scene.striker.velocity = 4000.0;
  const Result result = simulate(input);
  EXPECT_EQ(result.outcome.kind, OutcomeKind::left_validity);
  EXPECT_GT(result.outcome.time, 0.0);
  EXPECT_EQ(result.sub_impacts.size(), 1u);
  expect_in(result.outcome.message, "thickness");
}

TEST(APadThickerThanTheBeam, IsASpringThatGivesWayAsFarAsItMust) {
  Case input = rigid_case(ContactKind::linear, 2.0, 0.1);
  input.scene.contact.stiffness = 2e3;
  const Result result = simulate(input);
  ASSERT_TRUE(result.outcome.completed()) << result.outcome.message;
  const double depth = 2.0 * std::sqrt(reduced_mass(input) / 2e3);
  EXPECT_GT(depth, input.scene.beam.height());
  EXPECT_NEAR(result.max_indentation, depth, 1e-6 * depth);
}

}  // namespace
}  // namespace subimpact
