// One scene modelled in two ways that must agree.

#include "paper_case.h"

namespace subimpact {
namespace {

double largest_relative_difference(const Result& a, const Result& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.sub_impacts.size(); ++i) {
    const SubImpact& p = a.sub_impacts[i];
    const SubImpact& q = b.sub_impacts[i];
    if (i > 0) worst = std::max(worst, std::abs(p.start / q.start - 1.0));
    EXPECT_EQ(p.end.has_value(), q.end.has_value());
    if (p.end && q.end) worst = std::max(worst, std::abs(*p.end / *q.end - 1.0));
    worst = std::max(worst, std::abs(p.max_indentation / q.max_indentation - 1.0));
  }
  return worst;
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
  ASSERT_EQ(half.sub_impacts.size(), whole.sub_impacts.size());
  ASSERT_GE(half.sub_impacts.size(), 8u);
  EXPECT_LT(largest_relative_difference(half, whole), 1e-9);
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
  const Result right = simulate(input);
  ASSERT_EQ(left.sub_impacts.size(), right.sub_impacts.size());
  EXPECT_LT(largest_relative_difference(left, right), 1e-9);
}

TEST(TheMassSolvers, GiveTheSameEvents) {
  Case input = paper_case(SectionKind::elastic, 0.5e-3);
  input.solver.step = 1e-7;
  const Result banded = simulate(input);
  input.study.mass_solver = MassSolverKind::klu;
  const Result klu = simulate(input);
  ASSERT_EQ(banded.sub_impacts.size(), klu.sub_impacts.size());
  EXPECT_LT(largest_relative_difference(banded, klu), 1e-9);
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

}  // namespace
}  // namespace subimpact
