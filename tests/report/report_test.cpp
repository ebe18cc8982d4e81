#include "subimpact/io/report.h"
#include "subimpact/report/studies.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "report/page_data.h"
#include "sample_result.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"
#include "subimpact/simulate/method_tables.h"

namespace subimpact {
namespace {

Case paper_case() { return read_case_file(SUBIMPACT_PAPER_CASE).value; }

void expect_in(const std::string& text, const std::string& piece) {
  EXPECT_NE(text.find(piece), std::string::npos) << '"' << piece << "\" is not in:\n" << text;
}

TEST(SubImpactTable, ShowsMicrosecondsMillimetresAndNewtons) {
  const std::string table = sub_impact_table(sample_result());
  expect_in(table, "333.3333");   // end, us
  expect_in(table, "8796.31");    // peak force, N
  expect_in(table, "0.1696389");  // indentation, mm
}

TEST(SubImpactTable, SetsZonesAndSubZonesApartAndMarksAnOpenEnd) {
  const std::string table = sub_impact_table(sample_result());
  const auto zone_1 = table.find("zone 1\n");
  const auto subzone_2 = table.find("sub-zone 2\n");
  const auto zone_2 = table.find("\nzone 2\n");
  const auto open = table.find("(open)");
  ASSERT_NE(open, std::string::npos) << table;
  EXPECT_LT(zone_1, subzone_2);
  EXPECT_LT(subzone_2, zone_2);
  EXPECT_LT(zone_2, open);
}

// The line of a table that begins with that number.
std::string row_of(const std::string& table, const std::string& number) {
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    std::string first;
    std::istringstream(line) >> first;
    if (first == number) return line;
  }
  ADD_FAILURE() << "no row " << number << " in:\n" << table;
  return {};
}

TEST(SubImpactTable, GivesTimesTheirErrorsAndNoDigitBelow) {
  const std::string table = sub_impact_table(sample_result_with_errors(2));
  expect_in(row_of(table, "1"), "333.333 +- 0.017");
  expect_in(row_of(table, "2"), "500.0 +- 0.3");
  expect_in(row_of(table, "2"), "600.0   +- 0.3");
  // 0.52 us of 100 us: 0.52 % of 8796 N and of 0.1 N s.
  expect_in(row_of(table, "2"), " 100.0 ");
  expect_in(row_of(table, "2"), " 8800");
  expect_in(row_of(table, "2"), "0.1000");
  EXPECT_EQ(row_of(table, "2").find("0.10000"), std::string::npos) << table;
}

TEST(SubImpactTable, ShowsTheExactFirstStartWithoutAnError) {
  const std::string row = row_of(sub_impact_table(sample_result_with_errors(2)), "1");
  std::istringstream words(row);
  std::string number, start, end;
  words >> number >> start >> end;
  EXPECT_EQ(start, "0") << row;
  EXPECT_EQ(end, "333.333") << row;
}

TEST(SubImpactTable, MarksUndecidedRowsAndGivesTheReasonAboveThem) {
  const std::string table = sub_impact_table(sample_result_with_errors(1));
  const auto line = table.find("from here on not decided: they part\n");
  ASSERT_NE(line, std::string::npos) << table;
  EXPECT_LT(table.find("333.333"), line);
  EXPECT_GT(table.find("2?"), line);
  expect_in(row_of(table, "2?"), "500.0 +- ?");
  expect_in(row_of(table, "3?"), "5000.0 +- ?");  // the digits of the largest error
  EXPECT_EQ(row_of(table, "1").find('?'), std::string::npos) << table;
}

TEST(SubImpactTable, EndsWithTheReasonIfTheRefinedRunHasMoreSubImpacts) {
  Result result = sample_result_with_errors(3);
  result.error_estimate->first_unresolved = 3;
  result.error_estimate->reason = "the refined run has 4";
  const std::string last = "from here on not decided: the refined run has 4\n";
  const std::string table = sub_impact_table(result);
  EXPECT_EQ(table.rfind(last), table.size() - last.size()) << table;
  EXPECT_EQ(table.find("3?"), std::string::npos) << table;
}

TEST(SubImpactTable, KeepsDecimalPointsOfAColumnUnderEachOther) {
  for (const std::size_t n_decided : {0u, 1u, 3u}) {
    const std::string table = sub_impact_table(sample_result_with_errors(n_decided));
    const std::string mark = n_decided < 2 ? "?" : "";
    const std::string second = row_of(table, "2" + mark), third = row_of(table, "3" + mark);
    // start, and peak force: the columns before and after those that an open end leaves empty
    EXPECT_EQ(second.find("500.") + 3, third.find("5000.") + 4) << table;
    EXPECT_EQ(second.find("13"), third.find("13")) << table;
  }
}

TEST(SubImpactTable, WithErrorsThatMeanNothingShowsQuestionMarks) {
  Result result = sample_result_with_errors(3);
  for (const double error : {std::numeric_limits<double>::infinity(), 1e300, -1.0}) {
    result.sub_impacts[1].start_error = result.sub_impacts[1].end_error = error;
    expect_in(row_of(sub_impact_table(result), "2"), "+- ?");
  }
}

TEST(SubImpactTable, WithErrorsLargerThanTheTimesStillHasARowPerSubImpact) {
  Result result = sample_result_with_errors(3);
  for (SubImpact& s : result.sub_impacts) s.start_error = s.end_error = 7.0;
  expect_in(row_of(sub_impact_table(result), "2"), "0 +- 7000000");
}

// The line of a summary with that label.
std::string line_of(const std::string& summary, const std::string& label) {
  const auto begin = summary.find("  " + label);
  if (begin == std::string::npos) return {};
  return summary.substr(begin, summary.find('\n', begin) - begin);
}

TEST(RunSummary, GivesLargestForceAndFinalVelocitiesTheirErrors) {
  Result result = sample_result_with_errors(3);
  result.sub_impacts[2].end = result.sub_impacts[2].start + 1e-3;
  result.sub_impacts[2].start_error = result.sub_impacts[2].end_error = 0.5e-6;
  result.max_momentum_error = 1e-14;
  const std::string summary = run_summary(paper_case(), result);
  // 0.0163 us of 333.3 us: 0.0049 % of 8796 N, rounded up
  expect_in(line_of(summary, "maxima"), "force 8796.3 +- 0.5 N");
  EXPECT_EQ(line_of(summary, "final velocities").find("not known"), std::string::npos) << summary;
  expect_in(line_of(summary, "final velocities"), "+-");
}

TEST(RunSummary, DoesNotGiveDigitsToFinalVelocitiesAfterAnUndecidedSubImpact) {
  Result result = sample_result_with_errors(2);
  result.striker_velocity = 5.793326;
  expect_in(line_of(run_summary(paper_case(), result), "final velocities"),
            "striker 5.8 m/s (error not known)");
}

TEST(RunSummary, GivesAReasonOnce) {
  const std::string summary = run_summary(paper_case(), sample_result_with_errors(2));
  const auto first = summary.find("they part");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(summary.find("they part", first + 1), std::string::npos) << summary;
  expect_in(line_of(summary, "error of mesh"), "as above (refined run: the same, finer)");
}

TEST(TheoryTable, GivesTimesWithErrorsAndHowMuchLaterTheyCome) {
  TheoryRun rayleigh{BeamTheory::rayleigh, sample_result_with_errors(3), {}};
  TheoryRun timoshenko{BeamTheory::timoshenko, sample_result_with_errors(3), {}};
  timoshenko.result.sub_impacts[0].end = 1e-6 * 353.583;
  for (std::size_t i = 0; i < 3; ++i) {
    rayleigh.pairs.push_back({i, i});
    timoshenko.pairs.push_back({i, i});
  }
  const std::string table = theory_table({rayleigh, timoshenko});
  expect_in(table, "353.583 +- 0.017");
  expect_in(table, "+20.25");  // 353.583 - 333.333
  expect_in(table,
            "timoshenko: 3 sub-impacts, 3 by rayleigh; the first 3 correspond, with times up to "
            "20.25 us apart\n");
}

TEST(ErrorWords, OfDecidedTimesNameTheErrorAndTheEnd) {
  EXPECT_EQ(error_words(paper_case(), sample_result_with_errors(3)),
            "all times to 0.3 us up to 8 ms");
  expect_in(run_summary(paper_case(), sample_result_with_errors(3)),
            "  error               all times to 0.3 us up to 8 ms\n");
  expect_in(run_summary(paper_case(), sample_result_with_errors(3)), "3 in 2 zones, all decided\n");
}

TEST(ErrorWords, NameTheLastDecidedSubImpactItsEndAndTheReason) {
  EXPECT_EQ(error_words(paper_case(), sample_result_with_errors(2)),
            "times to 0.3 us up to sub-impact 2 (600 us); from there undecided: they part");
  const std::string summary = run_summary(paper_case(), sample_result_with_errors(2));
  expect_in(summary, "3 in 2 zones, 2 decided\n");
  expect_in(summary,
            "zone 2              1 sub-impact in 1 sub-zone, 5000.0 to (open) us, not decided\n");
  EXPECT_EQ(summary.find("times to 0.0e+00"), std::string::npos);
}

TEST(ErrorWords, OfNothingDecidedNameTheSettingToTry) {
  Result result = sample_result_with_errors(0);
  EXPECT_EQ(error_words(paper_case(), result),
            "no sub-impact is decided: they part; try a larger model.segments");
  result.error_estimate->parts.front().name = "time";
  expect_in(error_words(paper_case(), result), "; try a smaller solver.rtol");
  result.used.step = 1e-7;
  expect_in(error_words(paper_case(), result), "; try a shorter solver.step");
  result.error_estimate->parts.front().name = "layers";
  expect_in(error_words(paper_case(), result), "; try model.section = \"exact\"");
}

TEST(ErrorWords, OfARunWithoutErrorBarsSayHowToGetThem) {
  EXPECT_EQ(error_words(paper_case(), sample_result()),
            "not known; without --error-bars=off a companion run estimates it");
  expect_in(run_summary(paper_case(), sample_result()), "  error               not known; ");
}

TEST(FailureMessage, NamesTimeModeMethodLastEventAndCause) {
  Result result = sample_result();
  result.outcome = {OutcomeKind::solver_failed, 12.5e-6, "the library gave up", {}};
  const std::string message = failure_message(paper_case(), result);
  expect_in(message, "solver-failed at 12.5 us");
  expect_in(message, "in contact, sub-impact 3");
  expect_in(message, "method erk");
  expect_in(message, "last event section_reverses at 0.666667 us");
  expect_in(message, "the library gave up");
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST(FailureMessage, SaysWhenTheStrikerWasFree) {
  Result result = sample_result();
  result.sub_impacts.pop_back();
  expect_in(failure_message(paper_case(), result), "separated after sub-impact 2");
}

TEST(RunSummary, WeighsBeamAndStriker) {
  Case input = paper_case();
  expect_in(run_summary(input, sample_result()),
            "masses              beam 0.226055 kg, striker 0.201 kg");
  input.scene.beam.length *= 1e3;
  input.scene.beam.width *= 1e3;
  input.scene.beam.thickness *= 1e3;
  expect_in(run_summary(input, sample_result()), "beam 226055 t");
}

TEST(RunSummary, CountsOneAsOne) {
  Result result = sample_result();
  result.sub_impacts.resize(1);
  result.work.steps = 1;
  result.work.right_hand_sides = 1;
  result.work.roots = 1;
  const std::string summary = run_summary(paper_case(), result);
  expect_in(summary, "1 in 1 zone\n");
  expect_in(summary, "1 sub-impact in 1 sub-zone,");
  expect_in(summary, "1 step, 0 rejected, 1 right-hand side, 1 event;");
}

Result result_with_a_failed_check() {
  Result result = sample_result();
  result.outcome = {OutcomeKind::inaccurate, 2e-3, "the energy is off", Interval{1e-3, 1.5e-3}};
  return result;
}

constexpr const char* failed_check =
    "results up to 1000 us passed every check; first failure between 1000 and 1500 us";

TEST(FailedCheck, IsPlacedInTimeBySummaryFailureMessageAndWords) {
  const Result result = result_with_a_failed_check();
  expect_in(run_summary(paper_case(), result), failed_check);
  expect_in(failure_message(paper_case(), result), failed_check);
  expect_in(strike_words(paper_case(), result).front(), failed_check);
}

TEST(FailedCheck, MarksTheSubImpactTable) {
  EXPECT_EQ(sub_impact_table(result_with_a_failed_check())
                .find(std::string("inaccurate: ") + failed_check),
            0u);
  EXPECT_EQ(sub_impact_table(sample_result()).find("  "), 0u);
}

TEST(Warnings, AreShownInTheSummary) {
  Result result = sample_result();
  result.warnings = {"beam.length is 711.2 m"};
  expect_in(run_summary(paper_case(), result), "warning             beam.length is 711.2 m\n");
}

Result result_with_a_wish(const WishOutcome& wish) {
  Result result = sample_result();  // ends: 0.33, 0.6 and, still open, 8 ms
  result.wish = wish;
  return result;
}

TEST(Wish, MetUpToAHorizonNamesHorizonSubImpactsReasonAndKey) {
  const Result result =
      result_with_a_wish({1e-6, true, 0.3e-6, 840e-6, "its mesh is too coarse", "model.segments"});
  const std::string summary = run_summary(paper_case(), result);
  expect_in(
      summary,
      "wish                event times within 1 us: met up to 840 us, 2 of 3 sub-impacts (0.3 "
      "us reached); beyond: its mesh is too coarse; free model.segments\n");
  EXPECT_LT(summary.find("  wish "), summary.find("  model "));
  EXPECT_GT(summary.find("  wish "), summary.find("  outcome "));
}

TEST(Wish, MetToTheEndSaysNoMore) {
  const Result result = result_with_a_wish({1e-7, true, 0.3e-7, 8e-3, "", ""});
  EXPECT_EQ(wish_words(*result.wish, result),
            "event times within 0.1 us: met to the end (0.03 us reached)");
}

TEST(Wish, NotMetNamesTheErrorReachedOrThatItIsNotKnown) {
  const WishOutcome missed{1e-6, false, 2.5e-6, 8e-3, "model.segments is fixed", "model.segments"};
  EXPECT_EQ(wish_words(missed, sample_result()),
            "event times within 1 us: not met; 3 us reached to the end; model.segments is fixed; "
            "free model.segments");
  const WishOutcome unknown{1e-6, false, std::numeric_limits<double>::infinity(), 0.0, "", ""};
  EXPECT_EQ(wish_words(unknown, sample_result()),
            "event times within 1 us: not met; the error reached is not known");
}

TEST(Wish, IsNotMentionedWhereNoneWasMade) {
  EXPECT_EQ(run_summary(paper_case(), sample_result()).find("wish"), std::string::npos);
}

TEST(PlanTable, EndsWithItsHorizonAndNamesTheAdmittedMesh) {
  Plan plan;
  plan.wanted = 1e-6;
  plan.horizon = 285e-6;
  plan.horizon_reason = "the case's end";
  PlanPoint point;
  point.mesh = "96 elements";
  point.method = "exponential";
  point.input.model.mesh = MeshKind::hermite;
  point.input.model.elements = 96;
  point.verdict = Verdict::right;
  point.within = point.admitted = true;
  plan.points = {point};
  plan.cheapest = 0;
  const std::string table = plan_table(plan);
  EXPECT_NE(table.find("--method exponential --set model.mesh=hermite --set model.elements=96"),
            std::string::npos)
      << table;
  EXPECT_TRUE(table.ends_with("\njudged up to 285.000 us (the case's end)\n")) << table;
}

std::string explanation_of(const Case& input) {
  ResolvedRun run = resolve(input);
  return explanation(input, run.settings(), estimate_cost(run));
}

TEST(Explanation, TellsUnknownsSymmetrySectionStepTolerancesAndContact) {
  const Case input = paper_case();
  const std::string text = explanation_of(input);
  expect_in(text, "one half is modelled");
  expect_in(text, "251 of the beam and 1 of the striker");
  expect_in(text, "40 layers: elastic stiffness 0.999375");
  expect_in(text, "0.28");  // critical step, us
  expect_in(text, "2.948976e+10 N/m^1.5");
  expect_in(text, "0.0156337 mm");
  expect_in(text, "12.47 ms");
  expect_in(text, "right-hand sides");
}

TEST(Explanation, SaysThatAnInfiniteYieldStressLeavesNothingToYield) {
  Case input = paper_case();
  input.scene.beam.yield_stress = std::numeric_limits<double>::infinity();
  const std::string text = explanation_of(input);
  expect_in(text, "elastic, although \"layers\" was requested");
  expect_in(text, "the contact never yields");
}

TEST(Explanation, GivesTheLengthOfTheMesh) {
  Case input = paper_case();
  const auto text = [&] { return explanation(input, resolve(input).settings(), std::nullopt); };
  expect_in(text(), "501 cells, one half by symmetry; cells of 1.41956 mm\n");
  input.model.spacing = CellSpacing::points;
  expect_in(text(), "501 points, one half by symmetry; cells of 1.4224 mm");
  expect_in(text(), "a beam of 712.6224 mm\n");
}

TEST(Explanation, GivesTheReasonForAWholeModel) {
  Case input = paper_case();
  input.model.symmetry = SymmetryUse::off;
  expect_in(explanation(input, resolve(input).settings(), std::nullopt), "not used (model");
  input.model.symmetry = SymmetryUse::automatic;
  input.scene.striker.position = 0.4;
  expect_in(explanation(input, resolve(input).settings(), std::nullopt),
            "not symmetric about mid-span");
}

TEST(RunSummary, DoesNotCallAllDecidedWhereTheRunComparedWithHasMore) {
  Result result = sample_result_with_errors(3);
  result.error_estimate->first_unresolved = result.sub_impacts.size();
  expect_in(run_summary(paper_case(), result), "3 in 2 zones, 3 decided, which may not be all\n");
}

TEST(RunSummary, NamesTheKeyOfAFinerMeshWhereTheMeshDecidesNothing) {
  Result result = sample_result_with_errors(0);
  result.error_estimate->parts.clear();
  expect_in(run_summary(paper_case(), result), "try a larger model.segments");
}

TEST(CostEstimate, OfCentralDifferencesIsTheNumberOfStepsToTheEnd) {
  Case input = paper_case();
  input.solver.method = Method::central_difference;
  input.solver.step = 1e-7;
  ResolvedRun run = resolve(input);
  const auto cost = estimate_cost(run);
  ASSERT_TRUE(cost);
  EXPECT_NEAR(cost->steps, 80000.0, 1e-6);
  EXPECT_NEAR(cost->right_hand_sides, 80000.0, 1e-6);
  EXPECT_GT(cost->seconds, 0.0);
}

void expect_cost_within_a_factor_of_three(const Case& input) {
  ResolvedRun run = resolve(input);
  const auto cost = estimate_cost(run);
  ASSERT_TRUE(cost);
  const double counted = static_cast<double>(simulate(input).work.right_hand_sides);
  EXPECT_LT(cost->right_hand_sides, 3.0 * counted);
  EXPECT_GT(cost->right_hand_sides, counted / 3.0);
}

TEST(CostEstimate, OfAnAdaptiveMethodIsRightWithinAFactorOfThree) {
  Case input = paper_case();
  input.output.interval = 0.0;
  input.end_time = 2e-4;
  expect_cost_within_a_factor_of_three(input);
}

TEST(CostEstimate, IncludesTheStabilityLimitOfStrongDamping) {
  Case input = paper_case();
  input.output.interval = 0.0;
  input.end_time = 5e-5;
  input.scene.beam.damping.stiffness = 1e-5;
  expect_cost_within_a_factor_of_three(input);
}

TEST(Listings, NameEveryKeyMethodAndTable) {
  const std::string keys = fmt::format("\n{}", key_listing());
  for (const CaseKey& key : case_keys()) expect_in(keys, fmt::format("\n{} ", key.leaf()));
  const std::string methods = method_listing();
  for (const Choice& method : find_case_key("solver.method")->choices) {
    expect_in(methods, fmt::format("  {} ", method.name));
  }
  for (const MethodTable& table : method_tables())
    expect_in(methods, fmt::format(" {} ", table.name));
}

TEST(DurationText, ChoosesTheUnit) {
  EXPECT_EQ(duration_text(12.5e-6), "12.5 us");
  EXPECT_EQ(duration_text(8e-3), "8 ms");
  EXPECT_EQ(duration_text(3.25), "3.25 s");
}

}  // namespace
}  // namespace subimpact
