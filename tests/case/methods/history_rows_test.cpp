#include "paper_case.h"

namespace subimpact {
namespace {

// History rows at an interval that the case leaves open.
class OpenInterval : public testing::Test {
 protected:
  static Result run(std::optional<double> interval) {
    Case input = paper_case(SectionKind::elastic, 4e-3);
    input.solver.rtol = 1e-7;
    input.output.interval = interval;
    return simulate(input);
  }
};

TEST_F(OpenInterval, GivesTheForceOfEverySubImpactToAHundredthOfTheLargest) {
  const Result result = run(std::nullopt);
  const double resolved = 0.015 * result.max_force;  // a change of 1 %, and what a step adds
  ASSERT_GT(result.sub_impacts.size(), 5u);
  for (const SubImpact& s : result.sub_impacts) {
    double largest = 0.0;
    for (const HistoryRow& row : result.history) {
      const bool within = row.time >= s.start && row.time <= result.end_of(s);
      if (within) largest = std::max(largest, row.force);
    }
    EXPECT_NEAR(largest, s.peak_force, resolved);
  }
}

TEST_F(OpenInterval, KeepsRowsInOrderATwoThousandthOfTheRunApartAtMost) {
  const Result result = run(std::nullopt);
  for (std::size_t i = 1; i < result.history.size(); ++i) {
    const double apart = result.history[i].time - result.history[i - 1].time;
    ASSERT_GE(apart, 0.0);
    ASSERT_LE(apart, 4e-3 / 2000.0 * (1.0 + 1e-9));
  }
}

TEST_F(OpenInterval, AddsRowsDuringContactAlone) {
  const Result result = run(std::nullopt);
  const Result regular = run(4e-3 / 2000.0);
  EXPECT_GT(result.history.size(), regular.history.size() + 100);
  EXPECT_EQ(result.sub_impacts.back().start, regular.sub_impacts.back().start);
  EXPECT_EQ(result.striker_velocity, regular.striker_velocity);
  const auto in_flight = [&](const Result& of) {
    return std::ranges::count_if(of.history,
                                 [](const HistoryRow& row) { return row.force == 0.0; });
  };
  EXPECT_EQ(in_flight(result), in_flight(regular));
}

Case case_with_sections(std::vector<double> sections) {
  Case input = paper_case(SectionKind::exact, 2e-4);
  input.output.interval = 1e-6;
  input.output.sections = std::move(sections);
  return input;
}

TEST(SectionHistory, HasARowOfEverySectionAtEveryHistoryRow) {
  const Result result = simulate(case_with_sections({0.5, 0.3, 0.7}));
  ASSERT_EQ(result.section_history.size(), 3 * result.history.size());
  for (std::size_t i = 0; i < result.history.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(result.section_history[3 * i + k].time, result.history[i].time);
    }
  }
}

TEST(SectionHistory, IsOfTheSectionNearestToThePositionOrItsMirrorImage) {
  const Case input = case_with_sections({0.5, 0.3, 0.7, 0.0});
  const Result result = simulate(input);
  const double l = input.scene.beam.length;
  const double half_cell = 0.5 * l / 501.0 * (1.0 + 1e-12);
  EXPECT_NEAR(result.section_history[0].position, 0.5 * l, half_cell);
  EXPECT_NEAR(result.section_history[1].position, 0.3 * l, half_cell);
  EXPECT_EQ(result.section_history[2].position, result.section_history[1].position);
  EXPECT_NEAR(result.section_history[3].position, 0.0, 4.0 * half_cell);  // no section at the end
}

TEST(SectionHistory, FollowsTheSectionLaw) {
  const Case input = case_with_sections({0.5, 0.45});
  const Beam& beam = input.scene.beam;
  bool flowed = false;
  for (const SectionRow& row : simulate(input).section_history) {
    const double elastic = beam.bending_stiffness() * row.curvature;
    EXPECT_LE(std::abs(row.moment), 1.5 * beam.yield_moment());
    EXPECT_NEAR(row.plastic_curvature, (elastic - row.moment) / beam.bending_stiffness(),
                1e-9 * beam.yield_curvature());
    flowed = flowed || std::abs(row.plastic_curvature) > 0.1 * beam.yield_curvature();
  }
  EXPECT_TRUE(flowed);
}

}  // namespace
}  // namespace subimpact
