// Errors of openings, and doubts where they leave open which contacts are joined.

#include "subimpact/study/judgement/judgement.h"
#include "testing.h"

namespace subimpact {
namespace {

constexpr double um = 1e-6;
constexpr double us = 1e-6;

// Contacts of 100 us that begin 200 us after one another and are parted by these openings.
Result contacts(const std::vector<double>& openings) {
  Result result;
  result.outcome.time = 2e-3;
  for (const double opening : openings) {
    SubImpact s;
    s.start = 200.0 * us * static_cast<double>(result.sub_impacts.size());
    s.end = s.start + 100.0 * us;
    s.start_rate = 2.0;
    s.end_rate = -2.0;
    s.max_indentation = 100.0 * um;
    s.impulse = 0.1;
    s.opening = opening;
    result.sub_impacts.push_back(s);
  }
  assign_zones(result.sub_impacts, 1.0, 1.0);
  return result;
}

// By two runs beside it that are alike, contacts parted by less than `joined` being joined in all.
Result judged(Result run, Result other, double joined = 0.0) {
  Case input;
  input.scene.striker.velocity = 1.0;
  input.output.opening = joined;
  join_sub_impacts(run.sub_impacts, joined);
  join_sub_impacts(other.sub_impacts, joined);
  const std::vector<RunBeside> beside(2, {{input, ErrorSource::time, "another run", 1.0}, other});
  judge(input, run, beside);
  return run;
}

TEST(TheErrorOfAnOpening, CoversTheDifferenceAndIsAShareOfTheOpening) {
  const Result run = judged(contacts({2 * um, 400 * um, 30 * um, 100 * um}),
                            contacts({2.2 * um, 440 * um, 30 * um, 110 * um}));
  EXPECT_TRUE(run.all_certain());
  EXPECT_NEAR(*run.sub_impacts[0].opening_error, 2.8 * 0.2 * um, 1e-12);
  EXPECT_NEAR(*run.sub_impacts[1].opening_error, 2.8 * 40.0 * um, 1e-12);
  EXPECT_NEAR(*run.sub_impacts[2].opening_error, 2.8 * 3.0 * um, 1e-12);  // not 0 by chance
}

TEST(AnOpeningOfOneRunAlone, PutsNothingInDoubtIfItIsJoined) {
  Result run = contacts({50 * um, 50 * um, 50 * um}), other = run;
  // The second contact opens by a hair in the other run.
  SubImpact& second = other.sub_impacts[1];
  SubImpact rest = second;
  second.end = second.start + 60.0 * us;
  rest.start = second.start + 61.0 * us;
  second.opening = 0.1 * um;
  other.sub_impacts.insert(other.sub_impacts.begin() + 2, rest);
  EXPECT_FALSE(*judged(run, other).sub_impacts[1].certain);
  EXPECT_FALSE(*judged(other, run).sub_impacts[1].certain);
  for (const Result& joined : {judged(run, other, 1 * um), judged(other, run, 1 * um)}) {
    ASSERT_EQ(joined.sub_impacts.size(), 3u);
    EXPECT_TRUE(joined.all_certain()) << words_of(joined.error_estimate->reason);
  }
}

TEST(AnOpeningThatItsErrorLeavesOnEitherSideOfTheLimit, MakesTheContactsBesideItUncertain) {
  const Result run = contacts({50 * um, 1.2 * um, 50 * um, 50 * um});
  const Result near = contacts({50 * um, 1.25 * um, 50 * um, 50 * um});
  const Result far = contacts({50 * um, 1.4 * um, 50 * um, 50 * um});
  EXPECT_TRUE(judged(run, near, 1 * um).all_certain());
  const Result found = judged(run, far, 1 * um);
  EXPECT_TRUE(*found.sub_impacts[0].certain);
  EXPECT_FALSE(*found.sub_impacts[1].certain);
  EXPECT_FALSE(*found.sub_impacts[2].certain);
  EXPECT_TRUE(*found.sub_impacts[3].certain) << words_of(found.sub_impacts[3].doubt);
  expect_in(words_of(found.sub_impacts[1].doubt), "less than 1 um are joined");
}

TEST(AnOpeningBelowTheLimitThatItsErrorLeavesOnEitherSide, MakesTheJoinedContactUncertain) {
  const Result run = contacts({50 * um, 0.8 * um, 50 * um});
  const Result near = contacts({50 * um, 0.82 * um, 50 * um});
  const Result far = contacts({50 * um, 0.95 * um, 50 * um});
  EXPECT_TRUE(judged(run, near, 1 * um).all_certain());
  const Result found = judged(run, far, 1 * um);
  ASSERT_EQ(found.sub_impacts.size(), 2u);
  EXPECT_TRUE(*found.sub_impacts[0].certain);
  EXPECT_FALSE(*found.sub_impacts[1].certain);
}

TEST(ARunWithUncertainSubImpacts, TellsHowManyWouldBeCertainWereTheyJoined) {
  const Result run = contacts({0.1 * um, 50 * um});
  Result other = contacts({0.1 * um, 50 * um});
  join_sub_impacts(other.sub_impacts, 1 * um);
  const Result found = judged(run, other);
  EXPECT_EQ(found.n_certain(), 0u);
  ASSERT_TRUE(found.error_estimate->joined);
  EXPECT_EQ(found.error_estimate->joined->n, 1u);
  EXPECT_EQ(found.error_estimate->joined->n_certain, 1u);
  // Two of ten.
  const std::vector<double> more(8, 50 * um);
  std::vector<double> openings{0.1 * um};
  openings.insert(openings.end(), more.begin(), more.end());
  Result parted = contacts(openings), closed = parted;
  join_sub_impacts(closed.sub_impacts, 1 * um);
  const Result few = judged(parted, closed);
  EXPECT_LT(few.sub_impacts.size() - *few.n_certain(), 3u);
  EXPECT_EQ(few.error_estimate->joined->n_certain, few.error_estimate->joined->n);
  EXPECT_FALSE(judged(run, run).error_estimate->joined);
  EXPECT_FALSE(judged(run, other, 1 * um).error_estimate->joined);
}

}  // namespace
}  // namespace subimpact
