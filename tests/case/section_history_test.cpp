#include "paper_case.h"
#include "testing.h"

namespace subimpact {
namespace {

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

TEST(SectionHistory, ChangesNothingElse) {
  Case input = case_with_sections({});
  const Result without = simulate(input);
  input.output.sections = {0.5};
  const Result with = simulate(input);
  EXPECT_TRUE(without.section_history.empty());
  EXPECT_EQ(with.sub_impacts.back().start, without.sub_impacts.back().start);
  EXPECT_EQ(with.striker_velocity, without.striker_velocity);
  EXPECT_EQ(with.history.size(), without.history.size());
}

TEST(SectionHistory, WithoutHistoryRowsIsRefused) {
  Case input = case_with_sections({0.5});
  input.output.interval = 0.0;
  EXPECT_THROW(simulate(input), InvalidCase);
}

}  // namespace
}  // namespace subimpact
