// The run of the struck-beam paper: 501 points 1/500 of the length apart, 40 layers, 0.1 us. Its
// printed numbers are met within a unit of their last digit (validation/physics/paper/as_computed).

#include "paper_case.h"

namespace subimpact {
namespace {

Case published_run(double end_time) {
  Case input = paper_case(SectionKind::layers, end_time, 501, Method::central_difference);
  input.model.spacing = CellSpacing::points;
  input.solver.step = 1e-7;
  input.study.striker_update = StrikerUpdate::constant_force;
  return input;
}

double first_separation_us(const Case& input) { return end_us(simulate(input).sub_impacts.at(0)); }

TEST(ThePublishedRun, Has18And39SubImpactsAtThePrintedTimes) {
  const Result result = completed(published_run(8e-3));
  const auto& found = result.sub_impacts;
  const auto second =
      std::find_if(found.begin(), found.end(), [](const SubImpact& s) { return s.zone == 2; });
  ASSERT_EQ(found.size(), 57u);
  EXPECT_EQ(second - found.begin(), 18);
  EXPECT_EQ(found.back().zone, 2);
  EXPECT_EQ(found[17].subzone, 2);
  EXPECT_NEAR(end_us(found[0]), 203.0, 1.0);
  EXPECT_NEAR(1e-3 * end_us(found[17]), 1.757, 0.001);
  EXPECT_NEAR(1e-3 * start_us(found[18]), 5.178, 0.001);
  EXPECT_NEAR(1e-3 * end_us(found[56]), 7.031, 0.001);
  EXPECT_NEAR(1e-3 * (start_us(found[18]) - end_us(found[17])), 3.42, 0.01);
  EXPECT_NEAR(1e3 * result.sub_impacts[0].max_indentation, 0.169, 0.001);
}

TEST(ThePublishedRun, KeepsMomentumToRoundingAndEnergyToAThousandth) {
  const Result result = simulate(published_run(2e-3));
  EXPECT_LT(*result.max_momentum_error, 1e-11);
  EXPECT_LT(result.max_energy_error, 1e-3);
}

TEST(ThePublishedRun, SeparatesAtOneTimeWhateverTheMethod) {
  Case input = published_run(0.25e-3);
  EXPECT_NEAR(first_separation_us(input), 203.49, 0.02);
  input.study.striker_update = StrikerUpdate::central;
  EXPECT_NEAR(first_separation_us(input), 203.49, 0.02);
  input.solver.step.reset();
  for (const Method method : {Method::erk, Method::nystrom, Method::exponential, Method::adams}) {
    input.solver.method = method;
    EXPECT_NEAR(first_separation_us(input), 203.455, 0.005) << static_cast<int>(method);
  }
}

// 1/501 of the length apart, contact goes on: the indentation stays 0.02 um above the residual one.
TEST(ThePublishedRun, SeparatesLaterOnCellsThatFillTheBeam) {
  Case input = published_run(0.25e-3);
  input.model.spacing = CellSpacing::cells;
  EXPECT_NEAR(first_separation_us(input), 217.15, 0.05);
}

}  // namespace
}  // namespace subimpact
