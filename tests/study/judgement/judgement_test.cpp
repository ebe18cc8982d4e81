// Verdicts on sub-impacts of results made by hand.

#include "subimpact/study/judgement/judgement.h"

#include <cmath>
#include <ctime>

#include "paper_run.h"
#include "subimpact/study/judgement/event_errors.h"
#include "testing.h"

namespace subimpact {
namespace {

// Counts, verdicts and totals of a judged run are one account: zones add up to the run, their
// times have no smaller errors than those of their sub-impacts, the number of sub-impacts has no
// error where all are certain, and contact is not said to be over where another sub-impact is
// possible.
void expect_one_account(const Result& result) {
  ASSERT_TRUE(result.error_estimate);
  const ErrorEstimate& estimate = *result.error_estimate;
  const auto named = std::ranges::find(estimate.totals, RunTotal::sub_impacts, &NamedTotal::name);
  ASSERT_NE(named, estimate.totals.end());
  const auto& [count, error] = named->total;
  const auto n = static_cast<double>(result.sub_impacts.size());
  EXPECT_EQ(count, n);
  double of_zones = 0.0, errors = 0.0;
  for (const ZoneTotals& zone : estimate.zones) {
    of_zones += zone.sub_impacts.value;
    errors += zone.sub_impacts.error.value_or(HUGE_VAL);
  }
  EXPECT_EQ(of_zones, n);
  for (const SubImpact& s : result.sub_impacts) {
    const ZoneTotals& zone = estimate.zones.at(static_cast<std::size_t>(s.zone - 1));
    EXPECT_TRUE(s.start != zone.start.value || zone.start.error.value_or(1.0) >= s.start_error);
    EXPECT_TRUE(s.end != zone.end.value || zone.end.error.value_or(1.0) >= s.end_error);
  }
  EXPECT_EQ(errors, n > 0.0 ? error.value_or(HUGE_VAL) : 0.0);
  const double n_doubts = n - static_cast<double>(*result.n_certain()) +
                          static_cast<double>(estimate.uncertain_flights.size());
  EXPECT_GE(error.value_or(HUGE_VAL), n_doubts);
  EXPECT_TRUE(estimate.finer_meshes || !error || result.all_certain() == (*error == 0.0));
  const bool may_have_more = estimate.doubt_after(result.sub_impacts.size() - 1) != nullptr;
  EXPECT_FALSE(result.contact_over && may_have_more);
}

constexpr double um = 1e-6;
constexpr double us = 1e-6;

SubImpact contact(double start, std::optional<double> end) {
  SubImpact s;
  s.start = start;
  s.end = end;
  s.start_rate = 2.0;
  s.end_rate = -2.0;
  s.max_indentation = 100.0 * um;
  s.zone = s.subzone = 1;
  return s;
}

// Contacts of 100 us that begin 200 us after one another, up to 1 ms.
Result contacts(int n, double later = 0.0) {
  Result result;
  result.outcome.time = 1e-3;
  for (int i = 0; i < n; ++i) {
    const double start = 200.0 * us * i + (i > 0 ? later : 0.0);
    result.sub_impacts.push_back(contact(start, start + 100.0 * us));
  }
  return result;
}

// By `n` runs beside it, all alike.
Result judged(Result run, const Result& other, std::size_t n = 2) {
  Case input;
  input.scene.striker.velocity = 1.0;
  const std::vector<RunBeside> beside(n, {{input, ErrorSource::time, "another run", 1.0}, other});
  judge(input, run, beside);
  return run;
}

TEST(AJudgement, CallsCertainWhatAgreesAndStatesMoreThanTheDifference) {
  const Result run = judged(contacts(3), contacts(3, 0.5 * us));
  EXPECT_TRUE(run.all_certain());
  EXPECT_EQ(run.sub_impacts[0].start_error, 0.0);
  EXPECT_NEAR(*run.sub_impacts[1].start_error, 2.4 * 0.5 * us, 1e-12);
  const Result by_one = judged(contacts(3), contacts(3, 0.5 * us), 1);
  EXPECT_NEAR(*by_one.sub_impacts[1].start_error, 1.5 * *run.sub_impacts[1].start_error, 1e-12);
}

TEST(AJudgement, TakesErrorsButNoDoubtFromARunThatDoesNotCountForExistence) {
  Case input;
  input.scene.striker.velocity = 1.0;
  Result run = contacts(3), without = contacts(2, 0.8 * us);
  std::vector<RunBeside> beside{
      {{input, ErrorSource::time, "a near run", 1.0}, contacts(3, 0.5 * us)},
      {{input, ErrorSource::time, "another one", 1.0}, contacts(3, 0.5 * us)},
      {{input, ErrorSource::time, "a far run", 1.0}, without}};
  beside.back().of.of_existence = false;
  judge(input, run, beside);
  EXPECT_TRUE(run.all_certain());
  EXPECT_NEAR(*run.sub_impacts[1].start_error, 2.4 * 0.8 * us, 1e-12);
  beside.back().of.of_existence = true;
  judge(input, run, beside);
  EXPECT_FALSE(*run.sub_impacts[2].certain);
}

// Processor time (s) of judging so many contacts, each a zone with a near miss before and after its
// end, by runs that lack the second half of them and have others instead.
double seconds_of_judging(int n) {
  const auto made = [n](double later) {
    Result run = contacts(n);
    for (std::size_t i = 0; i < run.sub_impacts.size(); ++i) {
      SubImpact& s = run.sub_impacts[i];
      if (2 * i > run.sub_impacts.size()) s.start += later, *s.end += later;
      s.zone = static_cast<int>(i) + 1;
      run.near_misses.push_back({s.start + 50.0 * us, 1e-9, NearMissKind::opening});
      run.near_misses.push_back({*s.end + 20.0 * us, 1e-9, NearMissKind::closing});
    }
    run.outcome.time = run.sub_impacts.back().start + 1e-3;
    return run;
  };
  Result run = made(0.0);
  const Result other = made(120.0 * us);
  const std::clock_t start = std::clock();
  run = judged(std::move(run), other);
  EXPECT_EQ(run.error_estimate->zones.size(), static_cast<std::size_t>(n));
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

TEST(AJudgement, OfTwiceAsManyContactsTakesTwiceAsLong) {
  double least = HUGE_VAL;
  for (int k = 0; k < 3; ++k) least = std::min(least, seconds_of_judging(10'000));
  const double most = seconds_of_judging(40'000);
  EXPECT_LT(most, 4.0 * 1.6 * least + 0.05);
}

Result judged_by_near_and_far(Result run, const Result& near, const Result& far) {
  Case input;
  input.scene.striker.velocity = 1.0;
  std::vector<RunBeside> beside{{{input, ErrorSource::time, "a near run", 1.0}, near},
                                {{input, ErrorSource::time, "a far run", 1.0}, far}};
  beside.back().of.of_existence = false;
  judge(input, run, beside);
  return run;
}

TEST(AJudgement, ByOneNearRunAndAFarOneStatesMoreThanByTwoNearOnes) {
  const Result other = contacts(3, 0.5 * us);
  const Result run = judged_by_near_and_far(contacts(3), other, other);
  EXPECT_NEAR(*run.sub_impacts[1].start_error, 2.7 * 0.5 * us, 1e-12);
}

// By a near run that agrees and a far one that lacks the fourth of seven contacts; all that both
// have comes `later` in the far run.
Result judged_beside_far_run_without_one(double later) {
  Result run = contacts(7), far = contacts(7, later);
  run.outcome.time = far.outcome.time = 2e-3;
  far.sub_impacts.erase(far.sub_impacts.begin() + 3);
  return judged_by_near_and_far(run, run, far);
}

TEST(AJudgement, DoubtsWhatAFarRunLacksOnlyWhereTwiceItsOwnErrorIsBelowIndentationAndOpenings) {
  // Indentations and openings are of 100 us at 2 m/s: 100 and 50 um.
  const Result near = judged_beside_far_run_without_one(10.0 * us);  // an error of 20 um
  EXPECT_EQ(near.sub_impacts[3].doubt->kind, Reason::Kind::missing_beside);
  EXPECT_EQ(near.n_certain(), 6u);
  const Result far = judged_beside_far_run_without_one(14.0 * us);  // of 28 um
  EXPECT_TRUE(*far.sub_impacts[3].certain) << words_of(far.sub_impacts[3].doubt);
}

// The end of a contact that nearly stays is known badly, but not whether there is a contact.
TEST(AJudgement, JudgesTheLengthsBesideAGrazeByTheErrorsAroundIt) {
  Result run = contacts(7), other = contacts(7, 1.0 * us);
  run.sub_impacts[3].end_rate = -0.02;
  *other.sub_impacts[3].end += 50.0 * us;
  const Result found = judged_by_near_and_far(run, other, other);
  EXPECT_GT(*found.sub_impacts[3].end_error, *run.sub_impacts[3].end - run.sub_impacts[3].start);
  EXPECT_TRUE(*found.sub_impacts[3].certain) << words_of(found.sub_impacts[3].doubt);
}

TEST(AJudgement, DoesNotTakeAgreementByChanceForAccuracyOfAValue) {
  Result run = contacts(5), other = contacts(5);
  for (SubImpact& s : other.sub_impacts) s.impulse += 1e-3;
  other.sub_impacts[2].impulse = run.sub_impacts[2].impulse;
  const Result found = judged(run, other);
  EXPECT_NEAR(*found.sub_impacts[2].impulse_error, 2.8e-3, 1e-12);
}

TEST(AJudgement, HearsNothingFromARunBeyondWhereItStopped) {
  Result stopped = contacts(2);
  stopped.outcome = {OutcomeKind::inaccurate, 350.0 * us, "", {}};
  const Result run = judged(contacts(3), stopped);
  EXPECT_FALSE(*run.sub_impacts[2].certain);
  EXPECT_EQ(words_of(run.error_estimate->reason),
            "the run with another run stopped before its end, at 350 us");
}

TEST(AJudgement, HearsOfNoFlightAndOfNoUnfinishedForceFromARunThatStopped) {
  Result stopped = contacts(3);
  stopped.outcome = {OutcomeKind::inaccurate, 450.0 * us, "", {}};
  stopped.sub_impacts[2].end.reset();
  stopped.sub_impacts[2].peak_force = 1.0;
  Result run = contacts(3);
  for (SubImpact& s : run.sub_impacts) s.peak_force = 1000.0;
  stopped.sub_impacts[0].peak_force = stopped.sub_impacts[1].peak_force = 1000.0;
  Result found = judged(run, stopped);
  EXPECT_FALSE(*found.sub_impacts[2].certain);
  EXPECT_FALSE(found.sub_impacts[2].peak_force_error) << "the other run has not reached it";
  run.sub_impacts.pop_back();
  stopped.sub_impacts.pop_back();
  found = judged(run, stopped);
  EXPECT_TRUE(*found.sub_impacts[1].certain);
  EXPECT_FALSE(found.all_certain()) << "nothing is known of the flight to the end";
  expect_one_account(found);
}

TEST(AJudgement, IsOneAccountOfCountsVerdictsAndTotals) {
  Result last_zone = contacts(5);
  last_zone.sub_impacts[3].zone = last_zone.sub_impacts[4].zone = 2;
  Result split = contacts(5), fewer = contacts(4), over = contacts(3);
  split.sub_impacts[4].end = 840.0 * us;
  split.sub_impacts.push_back(contact(850.0 * us, 900.0 * us));
  over.no_more_contact = split.no_more_contact = 950.0 * us;
  Result beside_over = contacts(4);
  beside_over.no_more_contact = 950.0 * us;
  const std::pair<Result, Result> pairs[] = {
      {last_zone, contacts(5)}, {last_zone, split}, {last_zone, fewer}, {fewer, last_zone},
      {over, beside_over},      {over, over},       {Result(), over},   {Result(), Result()}};
  for (const auto& [run, other] : pairs) expect_one_account(judged(run, other));
  // A run that shows errors alone does not change the count of what is certain.
  Case input;
  input.scene.striker.velocity = 1.0;
  std::vector<RunBeside> beside(2, {{input, ErrorSource::time, "a near run", 1.0}, contacts(5)});
  beside.push_back({{input, ErrorSource::time, "a far run", 1.0}, split});
  beside.back().of.of_existence = false;
  judge(input, last_zone, beside);
  EXPECT_TRUE(last_zone.all_certain());
  expect_one_account(last_zone);
}

TEST(AJudgement, OfRealRunsIsOneAccount) {
  for (const double end : {0.4e-3, 2e-3, 6e-3}) {
    Case input = paper_run(SectionKind::elastic, end, 61, Method::exponential);
    const Result judged = simulate_judged(input, cases_beside(input), 2);
    expect_one_account(judged);
    expect_one_account(simulate_judged(input, cases_beside_on_given_mesh(input), 2));
  }
}

// Four contacts, the second of which is split in two.
Result split_contacts() {
  Result result = contacts(4);
  const SubImpact split = result.sub_impacts[1];
  result.sub_impacts[1].end = split.start + 60.0 * us;
  result.sub_impacts.insert(result.sub_impacts.begin() + 2,
                            contact(split.start + 70.0 * us, *split.end));
  return result;
}

TEST(AJudgement, AsksForCloserAgreementAfterAnUncertainSubImpactOfTheSameSubZone) {
  Result run = contacts(4), other = split_contacts();
  run.near_misses = {{450.0 * us, 1.0 * um, NearMissKind::opening}};
  other.near_misses = {{450.0 * us, 1.3 * um, NearMissKind::opening}};  // an error of 0.75 um
  EXPECT_FALSE(*judged(run, other).sub_impacts[2].certain);
  EXPECT_TRUE(*judged(run, other).sub_impacts[3].certain);
  run.sub_impacts[2].subzone = 2;
  EXPECT_TRUE(*judged(run, other).sub_impacts[2].certain);
}

TEST(AJudgement, CallsCertainWhatFollowsAnUncertainSubImpact) {
  const Result run = judged(contacts(4), split_contacts());
  EXPECT_FALSE(*run.sub_impacts[1].certain);
  EXPECT_LT(*run.sub_impacts[1].probability, 1.0);
  EXPECT_TRUE(*run.sub_impacts[2].certain) << words_of(run.sub_impacts[2].doubt);
  EXPECT_TRUE(*run.sub_impacts[3].certain) << words_of(run.sub_impacts[3].doubt);
  EXPECT_EQ(run.error_estimate->first_unresolved, 1u);
}

TEST(AJudgement, DoubtsTheLastFlightWhereAnotherRunHasOneMore) {
  const Result run = judged(contacts(2), contacts(3));
  EXPECT_EQ(run.n_certain(), 2u);
  EXPECT_FALSE(run.all_certain());
  ASSERT_EQ(run.error_estimate->uncertain_flights.size(), 1u);
  EXPECT_EQ(run.error_estimate->uncertain_flights[0].after, 1u);
}

TEST(AJudgement, DoubtsAContactThatOnlyOneOfTwoRunsEnds) {
  Result other = contacts(2);
  other.sub_impacts[1].end.reset();
  EXPECT_FALSE(*judged(contacts(2), other).sub_impacts[1].certain);
  EXPECT_FALSE(*judged(other, contacts(2)).sub_impacts[1].certain);
  EXPECT_TRUE(*judged(other, other).sub_impacts[1].certain);
}

TEST(AJudgement, DoubtsANearMissWhoseMarginDiffersByMoreThanIsLeft) {
  for (const NearMissKind kind : {NearMissKind::opening, NearMissKind::closing}) {
    const double time = kind == NearMissKind::opening ? 250.0 * us : 350.0 * us;
    Result run = contacts(3), other = contacts(3);
    run.near_misses = {{time, 1.0 * um, kind}};
    other.near_misses = {{time, 1.2 * um, kind}};  // stands for an error of 0.5 um
    EXPECT_TRUE(judged(run, other).all_certain());
    other.near_misses[0].margin = 1.5 * um;  // of 1.25 um
    EXPECT_EQ(judged(run, other).error_estimate->first_unresolved,
              kind == NearMissKind::opening ? 1u : 2u);
  }
}

TEST(AJudgement, CallsContactOverOnlyIfEveryRunProvesItAndEndsAlike) {
  Result proven = contacts(2);
  proven.no_more_contact = 1e-3;
  EXPECT_TRUE(judged(proven, proven).contact_over);
  EXPECT_FALSE(judged(proven, contacts(2)).contact_over);
  Result faster = proven;
  faster.striker_velocity += 0.1;
  EXPECT_FALSE(judged(proven, faster).contact_over);
}

TEST(AJudgement, StatesTheErrorOfTheClosestApproachAlsoOfBodiesThatNeverTouch) {
  for (const int n : {2, 0}) {
    Result run = contacts(n), other = contacts(n);
    run.closest_approach = {500.0 * us, 20.0 * um, {}};
    other.closest_approach = {501.0 * us, 21.0 * um, {}};
    EXPECT_NEAR(*judged(run, other).closest_approach->error, 2.5 * um, 1e-12) << n;
    other.closest_approach.reset();  // only the error of an indentation is then known
    const auto error = judged(run, other).closest_approach->error;
    ASSERT_TRUE(error);
    EXPECT_TRUE(n > 0 || !std::isfinite(*error));
  }
}

TEST(AJudgement, CallsNothingCertainAtTolerancesOfPercents) {
  Case input;
  input.scene.striker.velocity = 1.0;
  input.solver.method = Method::nystrom;
  for (const double rtol : {5e-3, 2e-2}) {
    input.solver.rtol = rtol;
    Result run = contacts(3);
    judge(input, run,
          std::vector<RunBeside>{{{input, ErrorSource::time, "another", 1.0}, contacts(3)}});
    EXPECT_EQ(run.n_certain(), rtol < 1e-2 ? 3u : 0u);
    EXPECT_EQ(run.error_estimate->first_unresolved.has_value(), rtol > 1e-2);
  }
}

TEST(AJudgement, OfAGivenMeshLeavesTheMeshToTheTotalsAndSaysWhatItChanges) {
  Result other = contacts(3, 20.0 * us);
  other.sub_impacts[0].end = 80.0 * us;
  other.max_force = 2.0;
  Result run = contacts(3);
  run.max_force = 1.0;
  std::vector<RunBeside> beside{
      {{Case(), ErrorSource::time, "another tolerance", 1.0}, contacts(3)},
      {{Case(), ErrorSource::mesh, "another mesh", 1.0}, other}};
  beside[1].of.of_rows = false;
  judge(Case(), run, beside);
  EXPECT_EQ(run.n_certain(), 3u);
  EXPECT_LT(run.sub_impacts[1].start_error, 1e-15);
  const auto& totals = run.error_estimate->totals;
  const auto force = std::ranges::find(totals, RunTotal::peak_force, &NamedTotal::name);
  ASSERT_NE(force, totals.end());
  EXPECT_GT(*force->total.error, 1.0);
  ASSERT_TRUE(run.error_estimate->finer_meshes.has_value());
  EXPECT_EQ(run.error_estimate->finer_meshes->n_there, 3u);
  EXPECT_NEAR(*run.error_estimate->finer_meshes->change_of_first_end, 20.0 * us, 1e-12);
}

TEST(AJudgement, OfThePapersCellsNamesTheOpeningThatFinerMeshesHave) {
  const Case input = paper_run(SectionKind::exact, 0.4e-3, 501, Method::nystrom);
  const Result run = simulate_judged(input, cases_beside_on_given_mesh(input), 1);
  ASSERT_TRUE(run.error_estimate && run.error_estimate->finer_meshes);
  EXPECT_NEAR(1e6 * *run.sub_impacts[0].end, 217.0, 0.5);
  EXPECT_NEAR(1e6 * *run.error_estimate->finer_meshes->change_of_first_end, -15.6, 0.5);
}

// Coarser meshes are refused for a strike so close to an end.
TEST(CasesBeside, AreFinerWhereTheStrikeIsTooNearAnEndForCoarserMeshes) {
  Case input = paper_run(SectionKind::elastic, 1e-3, 501, Method::exponential);
  input.model.mesh = MeshKind::hermite;
  input.model.elements = 50;
  input.scene.striker.position = 0.0108;
  const std::vector<CaseBeside> all = cases_beside(input);
  ASSERT_EQ(all.size(), 2u);
  for (const CaseBeside& beside : all) {
    EXPECT_EQ(beside.source, ErrorSource::mesh_and_time);
    EXPECT_GT(beside.input.model.elements, 50);
  }
}

TEST(ANearMiss, PutsTheContactThatOpensOrTheOneAfterTheSeparationInDoubt) {
  const Result run = contacts(2);
  const auto of = [&](double time, NearMissKind kind) {
    return first_in_doubt(run, {time, 1e-7, kind});
  };
  EXPECT_EQ(of(50 * us, NearMissKind::opening), 0u);
  EXPECT_EQ(of(150 * us, NearMissKind::closing), 1u);
  EXPECT_EQ(of(250 * us, NearMissKind::opening), 1u);
  EXPECT_EQ(of(350 * us, NearMissKind::closing), 2u);
}

}  // namespace
}  // namespace subimpact
