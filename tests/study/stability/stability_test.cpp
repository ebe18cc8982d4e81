// Methods fail where theory says, and the user is told.

#include "subimpact/study/stability/stability.h"

#include "paper_run.h"
#include "print.h"
#include "study/parallel.h"
#include "study/stability/free_vibration.h"

namespace subimpact {
namespace {

Case elastic_case(int segments, double end_time) {
  return paper_run(SectionKind::elastic, end_time, segments);
}

TEST(MeasuredCriticalSteps, AgreeWithTheoryOnFourMeshesInEveryBeamTheory) {
  const std::vector<CriticalStep> rows = critical_steps(elastic_case(301, 1e-3));
  std::set<std::string> methods;
  for (const CriticalStep& row : rows) {
    methods.insert(row.method);
    EXPECT_NEAR(row.measured / row.predicted, 1.0, row.method == "central-difference" ? 0.01 : 0.03)
        << row.method << ", " << row.segments << " cells";
  }
  EXPECT_EQ(methods.size(), 10u);                    // central differences and nine tables
  EXPECT_EQ(rows.size(), methods.size() * 3u * 4u);  // theories, meshes
}

TEST(StabilityLimits, AreThoseOfTheTables) {
  EXPECT_NEAR(stability_limit("erk:bogacki-shampine"), std::sqrt(3.0), 1e-3);
  EXPECT_NEAR(stability_limit("erk:zonneveld"), std::sqrt(8.0), 1e-3);
  EXPECT_NEAR(stability_limit("erk:dormand-prince"), 1.0, 0.005);
  EXPECT_NEAR(stability_limit("erk:dop853"), 5.96, 0.01);
  EXPECT_NEAR(stability_limit("erk:fehlberg-78"), 2.37, 0.01);
  EXPECT_NEAR(stability_limit("nystrom:dprkn12"), 8.33, 0.01);
  EXPECT_THROW(stability_limit("bdf"), InvalidCase);
  EXPECT_THROW(stability_limit("erk"), InvalidCase);  // whose table?
}

TEST(CashKarp, GrowsAtEveryStepThoughSlowly) {
  Case input = elastic_case(101, 1e-3);
  input.solver.table = "cash-karp";
  FreeVibration beam(input);
  const std::size_t top = beam.n_modes() - 1;
  for (const double angle : {0.5, 0.7, 0.85}) {
    const double growth = beam.growth(top, angle / beam.frequency(top), 64);
    EXPECT_GT(growth, 1.0 + 1e-6) << angle;
    EXPECT_LT(growth, 1.0 + 1e-4) << angle;
  }
}

TEST(TheEighthOrderNystroemTable, ResonatesInANarrowRangeWhereAStepIsHalfATurn) {
  const std::vector<Resonance> found = resonances("nystrom:dprkn8");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].from, 3.1404, 1e-3);
  EXPECT_NEAR(found[0].to, 3.1417, 1e-3);
  EXPECT_NEAR(found[0].growth - 1.0, 5.8e-4, 0.5e-4);
  EXPECT_TRUE(resonances("central-difference").empty());
  // And so it does on a beam.
  Case input = elastic_case(101, 1e-3);
  input.solver.method = Method::nystrom;
  FreeVibration beam(input);
  const std::size_t top = beam.n_modes() - 1;
  EXPECT_GT(beam.growth(top, 3.1410 / beam.frequency(top), 64), 1.0 + 4e-4);
  EXPECT_LT(beam.growth(top, 3.1300 / beam.frequency(top), 64), 1.0);
}

TEST(CentralDifferencesInStiffContact, NeedTheStepOfBeamContactAndStrikerTogether) {
  const std::vector<StiffContact> rows = stiff_contact(elastic_case(201, 1e-3));
  for (const StiffContact& row : rows) {
    EXPECT_NEAR(row.measured / row.predicted, 1.0, 0.01) << row.stiffness;
  }
  EXPECT_NEAR(rows.front().predicted / rows.front().beam_only, 1.0, 1e-3);
  EXPECT_LT(rows.back().predicted, 0.3 * rows.back().beam_only);
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

TEST(ImplicitTables, DampAsTheirCoefficientsSay) {
  const std::vector<Damping> rows = damping_of_implicit_tables(elastic_case(51, 1e-3));
  const auto left_at_ten = [&](const std::string& method) {
    for (const Damping& row : rows) {
      if (row.method == method && std::abs(row.angle - 10.0) < 1e-9) return row.measured;
    }
    return -1.0;
  };
  for (const Damping& row : rows) {
    EXPECT_NEAR(row.measured, row.predicted, 1e-8) << row.method << " at " << row.angle;
    EXPECT_LT(row.measured, 1.0 + 1e-3);
  }
  EXPECT_NEAR(left_at_ten("dirk:ark324"), 0.28, 0.005);
  EXPECT_NEAR(left_at_ten("dirk:esdirk436"), 0.75, 0.01);
  EXPECT_NEAR(left_at_ten("dirk:esdirk437"), 0.86, 0.005);
}

TEST(BackwardDifferentiation, GrowsFromOrderThreeOnAndDampsAtOrderTwo) {
  double low[6] = {}, high[6] = {};
  for (const MultistepGrowth& row : bdf_growths()) {
    if (row.growth <= 1.0 + 1e-9) continue;
    if (low[row.order] == 0.0) low[row.order] = row.angle;
    high[row.order] = row.angle;
  }
  EXPECT_EQ(low[1], 0.0);
  EXPECT_EQ(low[2], 0.0);
  EXPECT_LE(low[3], 0.11);
  EXPECT_NEAR(high[3], 1.94, 0.15);
  EXPECT_NEAR(low[5], 0.71, 0.06);
  EXPECT_NEAR(high[5], 9.39, 0.7);
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

TEST(BackwardDifferentiation, BlowsUpOnABeamAtLooseTolerancesFromOrderThreeOnAndIsReported) {
  Case input = elastic_case(501, 0.25e-3);
  input.solver.method = Method::bdf;
  input.solver.rtol = 1e-4;
  for (const int order : {2, 3, 4, 5}) {
    input.solver.max_order = order;
    const Result result = simulate(input);
    EXPECT_EQ(result.outcome.kind, order == 2 ? OutcomeKind::completed : OutcomeKind::unstable);
    if (order == 2) continue;
    expect_in(result.outcome.message, "grows without bound");
  }
  input.solver.rtol = 1e-7;  // whose steps stay below the range of growth
  EXPECT_TRUE(simulate(input).outcome.completed());
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

TEST(SubImpactsWithinOneStep, AreMissedWithoutTheSearchForPairs) {
  const std::vector<MissedPairs> rows = missed_pairs(elastic_case(501, 0.25e-3));
  const auto at = [&](double step) {
    return *std::find_if(rows.begin(), rows.end(),
                         [&](const MissedPairs& row) { return std::abs(row.step - step) < 1e-9; });
  };
  // Nothing is as short as a quarter of a microsecond, so nothing is missed either way.
  EXPECT_LT(0.25e-6, at(0.25e-6).shortest);
  EXPECT_EQ(at(0.25e-6).right_without, at(0.25e-6).right_with_search);
  EXPECT_LT(at(8e-6).right_without, at(8e-6).right_with_search - 5);
}

TEST(SubImpactsWithinOneStep, OfAnInterruptedStudyAreThoseOfTheStrikesThatEnded) {
  std::size_t ended = 0;
  const std::vector<MissedPairs> rows =
      missed_pairs(elastic_case(501, 0.25e-3), 1, [&](std::size_t n, std::size_t all) {
        EXPECT_EQ(n, ++ended);
        EXPECT_EQ(all, 40u);
        return n < 3;
      });
  EXPECT_EQ(ended, 3u);
  for (const MissedPairs& row : rows) {
    EXPECT_EQ(row.n_runs, 3);
    EXPECT_LE(row.right_with_search, 3);
  }
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

TEST(Layers, TendToTheExactSectionAsTheSquareOfTheirNumberAndTooFewMiscount) {
  Case input = elastic_case(501, 0.6e-3);
  input.model.section = SectionKind::layers;
  const LayerStudy study = layers_against_exact(input);
  const auto at = [&](int layers) {
    for (const LayerPoint& point : study.points) {
      if (point.layers == layers) return point.errors;
    }
    return EventErrors{};
  };
  EXPECT_FALSE(at(10).all_correspond());
  EXPECT_TRUE(at(40).all_correspond());
  EXPECT_TRUE(at(640).all_correspond());
  const double order = std::log2(at(40).median / at(640).median) / 4.0;
  EXPECT_GT(order, 1.6);
  EXPECT_LT(order, 2.4);
}

}  // namespace
}  // namespace subimpact
