#include "paper_run.h"
#include "print.h"
#include "subimpact/study/judgement/event_errors.h"
#include "subimpact/study/studies.h"

namespace subimpact {
namespace {

std::vector<SubImpact> sub_impacts(const std::vector<std::pair<double, double>>& times) {
  std::vector<SubImpact> list;
  for (const auto& [start, end] : times) {
    list.push_back({});
    list.back().start = start;
    list.back().end = end;
    list.back().peak_force = 100.0;
  }
  return list;
}

using Pairs = std::vector<std::pair<int, int>>;

Pairs match(const std::vector<std::pair<double, double>>& a,
            const std::vector<std::pair<double, double>>& b) {
  Pairs pairs;
  for (const MatchedPair& pair : match_sub_impacts(sub_impacts(a), sub_impacts(b))) {
    pairs.push_back({pair.first ? static_cast<int>(*pair.first) : -1,
                     pair.second ? static_cast<int>(*pair.second) : -1});
  }
  return pairs;
}

TEST(MatchedSubImpacts, CorrespondOneToOneWhereTheyOverlap) {
  EXPECT_EQ(match({{0, 10}, {20, 25}}, {{0, 10.2}, {19.8, 25}}), (Pairs{{0, 0}, {1, 1}}));
  EXPECT_EQ(match({{0, 10}, {12, 13}, {20, 25}}, {{0, 10}, {20, 25}}),
            (Pairs{{0, 0}, {1, -1}, {2, 1}}));
  EXPECT_EQ(match({{0, 10}, {20, 25}}, {{0, 10}, {12, 13}, {20, 25}}),
            (Pairs{{0, 0}, {-1, 1}, {1, 2}}));
  EXPECT_EQ(match({}, {{0, 1}}), (Pairs{{-1, 0}}));
  EXPECT_EQ(match({{0, 10}, {20, 40}}, {{0, 10}, {20, 29}, {31, 40}}).size(), 3u);  // two halves
}

TEST(MatchedSubImpacts, CountTheLeadingOnesUpToTheFirstOddOne) {
  auto a = sub_impacts({{0, 1}, {2, 3}, {4, 5}, {6, 7}}), b = sub_impacts({{0, 1}, {2, 3}, {6, 7}});
  EXPECT_EQ(n_leading_matches(match_sub_impacts(a, b)), 2u);
  a = sub_impacts({{0, 1}, {2, 3}});
  b = sub_impacts({{0, 1}, {2.1, 3}});
  a.back().end.reset();
  b.back().end.reset();
  EXPECT_EQ(n_leading_matches(match_sub_impacts(a, b)), 2u) << "both still open at the end";
}

TEST(ErrorsOfEventTimes, LeaveOutTheFirstStartAndKnowMedianAndLargest) {
  std::vector<SubImpact> run = sub_impacts({{0.0, 10.1}, {20.3, 30.0}, {40.0, 50.7}});
  run[1].peak_force = 101.0;
  const EventErrors errors = event_errors(run, sub_impacts({{0, 10}, {20, 30}, {40, 50}}));
  EXPECT_TRUE(errors.all_correspond());
  EXPECT_EQ(errors.n_corresponding, 3u);
  EXPECT_NEAR(errors.first, 0.1, 1e-12);
  EXPECT_NEAR(errors.last, 0.7, 1e-12);
  EXPECT_NEAR(errors.maximum, 0.7, 1e-12);
  EXPECT_NEAR(errors.median, 0.1, 1e-12);
  EXPECT_NEAR(errors.peak_force, 0.01, 1e-12);
}

TEST(ARunThatLosesASubImpact, IsOffByAtLeastThatOnesDuration) {
  const EventErrors errors =
      event_errors(sub_impacts({{0, 10.1}, {40, 50}}), sub_impacts({{0, 10}, {20, 26}, {40, 50}}));
  ASSERT_FALSE(errors.all_correspond());
  EXPECT_EQ(errors.n_corresponding, 1u);
  EXPECT_NEAR(errors.maximum, 0.1, 1e-12);
  EXPECT_NEAR(errors.overall(), 6.0, 1e-12);
  EXPECT_DOUBLE_EQ(errors.unmatched->start, 20.0);
}

TEST(TheReference, KnowsTheElasticEventsToABillionthOfAMicrosecond) {
  const Reference reference = compute_reference(paper_run(SectionKind::elastic, 2e-3), 1e-10);
  EXPECT_EQ(reference.sub_impacts.size(), 14u);
  EXPECT_LT(1e6 * reference.error, 1e-8);
  EXPECT_EQ(reference.horizon, 2e-3);
}

TEST(TheHorizon, LiesInTheLastSeparationThatIsCertain) {
  // In contact at the case's end, which therefore cannot be compared up to there.
  const Reference open = compute_reference(paper_run(SectionKind::elastic, 230e-6), 1e-10);
  ASSERT_EQ(open.sub_impacts.size(), 1u);
  EXPECT_GT(open.horizon, *open.sub_impacts.back().end);
  EXPECT_LT(open.horizon, 225.5e-6);
  EXPECT_EQ(open.result.outcome.time, open.horizon);
  // Nothing is certain to a tenth of the rounding of its time but what comes first.
  EXPECT_THROW(compute_reference(paper_run(SectionKind::elastic, 1e-3), 1e-25), InvalidCase);
  EXPECT_THROW(compute_reference(paper_run(SectionKind::elastic, 1e-4), 1e-10), InvalidCase);
}

WorkPrecisionOptions quick(std::vector<std::string> methods) {
  WorkPrecisionOptions options;
  options.methods = std::move(methods);
  options.timing_budget = 0.0;
  options.most_repeats = 1;
  return options;
}

std::vector<Trial> points_of(const WorkPrecision& study, const std::string& method) {
  std::vector<Trial> points;
  std::copy_if(study.points.begin(), study.points.end(), std::back_inserter(points),
               [&](const Trial& p) {
                 const bool is_central = method == "central-difference";
                 return p.setting.method == method && p.setting.fixed_step == is_central;
               });
  return points;
}

TEST(AWorkPrecisionStudy, FindsErrorsThatFallAsCostRisesAndMarksWhatBlowsUp) {
  const WorkPrecision study =
      work_precision(paper_run(SectionKind::elastic, 0.3e-3),
                     quick({"central-difference", "exponential", "erk:dormand-prince"}));
  const auto central = points_of(study, "central-difference");
  ASSERT_GE(central.size(), 5u);
  for (const Trial& point : central) EXPECT_EQ(point.verdict, Verdict::right);
  // Second order over eight halvings, give or take the phase of the last step.
  const double order = std::log2(central.front().errors.median / central.back().errors.median) /
                       static_cast<double>(central.size() - 1);
  EXPECT_GT(order, 1.7);
  EXPECT_LT(order, 2.4);
  EXPECT_GT(central.back().work.right_hand_sides, 200 * central.front().work.right_hand_sides);

  const auto erk = points_of(study, "erk:dormand-prince");
  EXPECT_EQ(erk.front().verdict, Verdict::unstable);  // rtol 1e-2
  expect_in(erk.front().message, "grows without bound");
  EXPECT_EQ(erk.back().verdict, Verdict::right);
  EXPECT_LT(1e6 * erk.back().errors.maximum, 1e-6);

  const std::vector<Recommendation> recommendations = recommendations_from(study.points);
  ASSERT_EQ(recommendations.size(), recommended_errors.size());
  for (const Recommendation& item : recommendations) {
    ASSERT_TRUE(item.point.has_value());
    EXPECT_LE(item.point->errors.maximum, item.wanted);
  }
}

Case linear(double end_time) {
  Case input = paper_run(SectionKind::elastic, end_time, 101);
  input.scene.contact = {ContactKind::linear, 2e7, {}, {}, {}};
  input.scene.striker.nose_radius.reset();
  return input;
}

TEST(OrdersAtFixedSteps, AreThoseOfTheTablesWhereForcesAreSmoothAndBoundedByHertz) {
  const std::vector<std::string> names = {"central-difference", "erk:bogacki-shampine",
                                          "erk:zonneveld", "erk:dormand-prince", "nystrom"};
  const WorkPrecision smooth = work_precision(linear(1.5e-3), quick(names));
  ASSERT_EQ(smooth.orders.size(), names.size());
  for (const MethodOrder& order : smooth.orders) {
    EXPECT_TRUE(order.bound == OrderBound::none) << order.method;
    ASSERT_TRUE(order.observed) << order.method;
    EXPECT_NEAR(*order.observed, order.smooth, 0.2) << order.method;
  }
  Case hertz = linear(1.5e-3);
  hertz.scene.contact = {ContactKind::hertz, 1e9, {}, {}, {}};
  const WorkPrecision bounded = work_precision(hertz, quick({"erk:dormand-prince", "nystrom"}));
  for (const MethodOrder& order : bounded.orders) {
    EXPECT_TRUE(order.bound == OrderBound::contact);
    EXPECT_DOUBLE_EQ(order.most.value(), 2.5);
    EXPECT_NEAR(order.observed.value(), 2.5, 0.5) << order.method;
  }
}

TEST(AWorkPrecisionStudy, LeavesOutWhatWouldTakeTooLongAndSaysSo) {
  WorkPrecisionOptions options = quick({"nystrom"});
  options.point_seconds = 1e-9;
  const WorkPrecision study = work_precision(paper_run(SectionKind::exact, 0.3e-3), options);
  ASSERT_EQ(study.points.size(), 4u);  // the first of each kind is run to see how long it takes
  EXPECT_EQ(study.points.back().verdict, Verdict::not_run);
  expect_in(study.points.back().message, "would take");
}

TEST(AnInterruptedStudy, KeepsThePointsItHas) {
  WorkPrecisionOptions options = quick({"central-difference"});
  std::size_t finished = 0;
  options.finished = [&](const WorkPrecision& study) { finished = study.points.size(); };
  options.progress = [&](double) { return finished < 3; };
  const WorkPrecision study = work_precision(paper_run(SectionKind::elastic, 0.6e-3), options);
  EXPECT_TRUE(study.interrupted);
  EXPECT_EQ(study.points.size(), 3u);
}

Trial trial(const char* method, double error, double seconds, Verdict verdict = Verdict::right) {
  Trial p;
  p.setting.method = method;
  p.errors.maximum = error;
  p.seconds = seconds;
  p.verdict = verdict;
  return p;
}

TEST(Recommendation, TakesTheCheapestOfThoseThatFindEverySubImpact) {
  const std::vector<Recommendation> recommendations =
      recommendations_from({trial("a", 2e-7, 3.0), trial("a", 2e-7, 2.0),
                            trial("a", 1e-9, 1.0, Verdict::wrong_count), trial("a", 5e-9, 7.0)});
  EXPECT_EQ(recommendations[0].point->seconds, 2.0);  // 1 us
  EXPECT_EQ(recommendations[1].point->seconds, 7.0);  // 0.1 us
  EXPECT_EQ(recommendations[2].point->seconds, 7.0);  // 0.01 us
  EXPECT_FALSE(recommendations[3].point.has_value());
}

TEST(Recommendation, TellsASettingThatReachesItsErrorByLuckFromOneThatDoesSteadily) {
  const std::vector<Recommendation> recommendations =
      recommendations_from({trial("a", 0.5e-6, 1.0), trial("a", 2e-6, 2.0), trial("a", 0.4e-6, 4.0),
                            trial("b", 1e-7, 3.0)});
  EXPECT_EQ(recommendations[0].point->seconds, 1.0);
  EXPECT_EQ(recommendations[0].steady->seconds, 3.0);
  EXPECT_EQ(recommendations[1].point->seconds, 3.0);
  EXPECT_FALSE(recommendations[1].steady.has_value());
}

}  // namespace
}  // namespace subimpact
