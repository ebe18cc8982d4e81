#include "paper_case.h"
#include "testing.h"

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
      if (row.time >= s.start && row.time <= result.end_of(s)) {
        largest = std::max(largest, row.force);
      }
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

}  // namespace
}  // namespace subimpact
