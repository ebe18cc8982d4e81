// Methods fail where theory says, and the user is told.

#include "subimpact/study/studies.h"

#include "paper_run.h"
#include "print.h"
#include "study/parallel.h"

namespace subimpact {
namespace {

Case elastic_case(int segments, double end_time) {
  return paper_run(SectionKind::elastic, end_time, segments);
}

TEST(CentralDifferencesInStiffContact, AreRefusedBelowTheBeamsOwnCriticalStepAndBlowUpIfForced) {
  Case input = elastic_case(501, 3e-4);
  input.scene.contact.kind = ContactKind::linear;
  input.scene.contact.stiffness = 1e12;
  input.scene.striker.nose_radius.reset();
  input.solver.method = Method::central_difference;
  const double beam_alone = 2.0 / resolve(input).settings().highest_frequency;
  input.solver.step = 0.9 * beam_alone;
  EXPECT_THROW(simulate(input), InvalidCase);
  input.study.beyond_critical = true;
  const Result result = simulate(input);
  EXPECT_EQ(result.outcome.kind, OutcomeKind::unstable);
  expect_in(result.outcome.message, "grows without bound");
}

std::map<std::string, std::map<double, OutcomePoint>> by_row(const OutcomeMap& map) {
  std::map<std::string, std::map<double, OutcomePoint>> rows;
  for (const OutcomePoint& point : map.points) {
    rows[(point.setting.fixed_step ? "fixed step " : "tolerance ") + point.row][point.x] = point;
  }
  return rows;
}

TEST(TheOutcomeMap, ShowsExplicitMethodsRefusedOrUnstableBeyondTheirLimitsAndSaysSo) {
  const auto rows =
      by_row(outcome_map(elastic_case(501, 0.25e-3), {"central-difference", "erk:dop853",
                                                      "erk:dormand-prince", "exponential"}));
  const auto& plain = rows.at("fixed step central-difference");
  EXPECT_EQ(plain.at(1.9).verdict, Verdict::right);
  EXPECT_EQ(plain.at(2.1).verdict, Verdict::refused);
  expect_in(plain.at(2.1).message, "stability limit");
  const auto& forced = rows.at("fixed step central-difference, forced");
  EXPECT_EQ(forced.at(1.9).verdict, Verdict::right);
  EXPECT_EQ(forced.at(2.1).verdict, Verdict::unstable);
  expect_in(forced.at(2.1).message, "grows without bound");
  EXPECT_EQ(rows.at("fixed step erk:dormand-prince").at(0.5).verdict, Verdict::right);
  EXPECT_EQ(rows.at("fixed step erk:dormand-prince").at(1.9).verdict, Verdict::unstable);
  EXPECT_EQ(rows.at("fixed step erk:dop853").at(5.8).verdict, Verdict::right);
  EXPECT_EQ(rows.at("fixed step erk:dop853").at(6.2).verdict, Verdict::unstable);
  // No frequency limits the exponential method.
  EXPECT_EQ(rows.at("fixed step exponential").at(64.0).verdict, Verdict::right);
}

TEST(ImplicitMethods, LoseEnergyAndThenSubImpactsAsTheStepGrows) {
  Case input = elastic_case(501, 0.52e-3);
  EXPECT_EQ(
      by_row(outcome_map(input, {"dirk:ark324"})).at("fixed step dirk:ark324").at(16.0).verdict,
      Verdict::inaccurate);
  input.accuracy.energy = 1.0;  // to see what the accounts keep from being reported
  const auto rows = by_row(outcome_map(input, {"dirk:ark324"}));
  const auto& row = rows.at("fixed step dirk:ark324");
  EXPECT_EQ(row.at(0.25).verdict, Verdict::right);
  EXPECT_GT(row.at(4.0).energy_error, 100.0 * row.at(0.5).energy_error);
  EXPECT_GT(row.at(8.0).errors.maximum, 1e3 * row.at(0.5).errors.maximum);
  EXPECT_EQ(row.at(16.0).verdict, Verdict::wrong_count);
  EXPECT_LT(row.at(16.0).errors.n_found, row.at(16.0).errors.n_reference);
  expect_in(row.at(16.0).message, "is missing or merged here");
  EXPECT_EQ(row.at(32.0).verdict, Verdict::failed);
  expect_in(row.at(32.0).message, "ARK_CONV_FAILURE");
}

TEST(InParallel, EveryTaskRunsOnceAndIsCountedAndNoneBeginsAfterAnEnd) {
  for (const unsigned jobs : {1u, 4u}) {
    std::vector<int> runs(100, 0);
    std::size_t last = 0;
    const auto task = [&](std::size_t i) { ++runs[i]; };
    in_parallel(runs.size(), jobs, task, [&](std::size_t n, std::size_t all) {
      EXPECT_EQ(n, ++last);  // one call at a time
      return all == 100;
    });
    EXPECT_EQ(last, 100u);
    EXPECT_EQ(std::ranges::count(runs, 1), 100);
    in_parallel(runs.size(), jobs, task, [](std::size_t n, std::size_t) { return n < 10; });
    EXPECT_GE(std::ranges::count(runs, 2), 10);
    EXPECT_LT(std::ranges::count(runs, 2), 10 + static_cast<int>(jobs));
  }
}

}  // namespace
}  // namespace subimpact
