// Near misses of whole runs, and what they leave undecided.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "paper_scene.h"
#include "study/error_part.h"
#include "subimpact/study/match.h"
#include "subimpact/study/mesh_error_bars.h"

namespace subimpact {
namespace {

Case paper_case(Method method, int segments) {
  Case input;
  input.scene = paper_scene();
  input.model.section = SectionKind::exact;
  input.model.segments = segments;
  input.end_time = 0.3e-3;
  input.solver.method = method;
  input.solver.rtol = 1e-8;
  input.output.interval = 0.0;
  return input;
}

// The near miss of this kind closest to a time (s).
NearMiss nearest_to(double time, NearMissKind kind, const Result& result) {
  NearMiss best{-1.0, 0.0, kind};
  for (const NearMiss& here : result.near_misses) {
    if (here.kind == kind && std::abs(here.time - time) < std::abs(best.time - time)) best = here;
  }
  return best;
}

TEST(NearMissesOfThePaper, On501CellsTheContactStaysSome21NanometresFromOpeningAt203us) {
  // The paper's scheme, but for the update of its striker.
  Case input = paper_case(Method::central_difference, 501);
  input.model.section = SectionKind::layers;
  input.solver.step = 1e-7;
  const NearMiss graze = nearest_to(203.2e-6, NearMissKind::opening, simulate(input));
  printf("%.3f us, %.4f um\n", 1e6 * graze.time, 1e6 * graze.margin);
  EXPECT_NEAR(graze.time, 203.2e-6, 0.1e-6);
  EXPECT_NEAR(graze.margin, 0.021e-6, 0.002e-6);
}

TEST(NearMissesOfThePaper, AreTheSameByMethodsWithAndWithoutLongSteps) {
  const Result result = simulate(paper_case(Method::nystrom, 501));
  const NearMiss graze = nearest_to(203.2e-6, NearMissKind::opening, result);
  for (const Method method : {Method::erk, Method::exponential, Method::central_difference}) {
    Case input = paper_case(method, 501);
    if (method == Method::central_difference) input.solver.step = 1e-8;
    const Result other = simulate(input);
    const NearMiss same = nearest_to(203.2e-6, NearMissKind::opening, other);
    printf("%.4f us, %.5f um\n", 1e6 * same.time, 1e6 * same.margin);
    EXPECT_NEAR(same.time, graze.time, 2e-9);
    EXPECT_NEAR(same.margin, graze.margin, 0.01 * graze.margin);
  }
}

TEST(NearMissesOfThePaper, LeaveTheFirstContactUndecidedThoughACoarserMeshAgrees) {
  const Case input = paper_case(Method::central_difference, 501);
  Result result = simulate(input);
  const Result coarser = simulate(on_other_mesh(input, 0.5)->input);
  // Both keep the first contact closed, which finer meshes split in two.
  EXPECT_NEAR(*result.sub_impacts[0].end, 217e-6, 1e-6);
  EXPECT_NEAR(*coarser.sub_impacts[0].end, 217e-6, 3e-6);
  set_error_bars(result, {compare_events(result, coarser, "mesh", "half as many cells", 1.0)});
  EXPECT_EQ(result.error_estimate->first_unresolved, 0u);
  const std::string& reason = result.error_estimate->reason;
  printf("%s\n", reason.c_str());
  EXPECT_NE(reason.find("at 203."), std::string::npos);
  EXPECT_NE(reason.find("contact nearly opens"), std::string::npos);
}

// --- made by hand -------------------------------------------------------------------------------

SubImpact contact(double start, std::optional<double> end) {
  SubImpact s;
  s.start = start;
  s.end = end;
  s.start_rate = 2.0;
  s.end_rate = -1.0;
  return s;
}

// Two contacts of 100 us with a separation of 100 us between them and one after them.
Result two_contacts(std::vector<NearMiss> near_misses, double later = 0.0) {
  Result result;
  result.outcome.kind = OutcomeKind::completed;
  result.sub_impacts = {contact(0.0, 100e-6 + later), contact(200e-6 + later, 300e-6 + later)};
  result.near_misses = std::move(near_misses);
  return result;
}

std::optional<std::size_t> first_unresolved(Result here, const Result& there, double factor) {
  set_error_bars(here, {compare_events(here, there, "mesh", "another mesh", factor)});
  return here.error_estimate->first_unresolved;
}

constexpr double um = 1e-6;
constexpr double us = 1e-6;

TEST(ANearMiss, PutsTheContactThatOpensOrTheOneAfterTheSeparationInDoubt) {
  const Result run = two_contacts({});
  const auto of = [&](double time, NearMissKind kind) {
    return first_in_doubt(run, {time, 1e-7, kind});
  };
  EXPECT_EQ(of(50 * us, NearMissKind::opening), 0u);
  EXPECT_EQ(of(150 * us, NearMissKind::closing), 1u);
  EXPECT_EQ(of(250 * us, NearMissKind::opening), 1u);
  EXPECT_EQ(of(350 * us, NearMissKind::closing), 2u);
}

TEST(ANearMiss, LeavesUndecidedWhatFollowsOnlyIfItsMarginIsBelowTheGapsError) {
  const auto with_margin = [](double opening, double closing) {
    return two_contacts(
        {{50 * us, opening, NearMissKind::opening}, {350 * us, closing, NearMissKind::closing}});
  };
  const Result run = with_margin(1.0 * um, 1.0 * um);
  EXPECT_EQ(first_unresolved(run, with_margin(1.1 * um, 0.9 * um), 1.0), std::nullopt);
  EXPECT_EQ(first_unresolved(run, with_margin(2.1 * um, 0.9 * um), 1.0), 0u);
  EXPECT_EQ(first_unresolved(run, with_margin(1.1 * um, 2.1 * um), 1.0), 2u);
  EXPECT_EQ(first_unresolved(run, with_margin(1.6 * um, 1.0 * um), 1.0), std::nullopt);
  EXPECT_EQ(first_unresolved(run, with_margin(1.6 * um, 1.0 * um), 2.0), 0u);
}

TEST(ANearMissWithoutACounterpart, IsJudgedByErrorAndRateOfTheNearestEvent) {
  // Half a microsecond at an end of 1 m/s: 0.5 um; at a start of 2 m/s: 1 um.
  const Result other = two_contacts({}, 0.5 * us);
  const auto with = [](NearMiss near_miss) { return two_contacts({near_miss}); };
  const auto judged = [&](double time, double margin, NearMissKind kind) {
    return first_unresolved(with({time, margin, kind}), other, 1.0);
  };
  EXPECT_EQ(judged(80 * us, 0.49 * um, NearMissKind::opening), 0u);
  EXPECT_EQ(judged(80 * us, 0.51 * um, NearMissKind::opening), std::nullopt);
  EXPECT_EQ(judged(210 * us, 0.99 * um, NearMissKind::opening), 1u);
  EXPECT_EQ(judged(210 * us, 1.01 * um, NearMissKind::opening), std::nullopt);
  EXPECT_EQ(judged(110 * us, 0.49 * um, NearMissKind::closing), 1u);
  EXPECT_EQ(judged(110 * us, 0.51 * um, NearMissKind::closing), std::nullopt);
  EXPECT_EQ(judged(190 * us, 0.99 * um, NearMissKind::closing), 1u);
  EXPECT_EQ(judged(190 * us, 1.01 * um, NearMissKind::closing), std::nullopt);
  EXPECT_EQ(judged(350 * us, 0.49 * um, NearMissKind::closing), 2u);
  EXPECT_EQ(judged(350 * us, 0.51 * um, NearMissKind::closing), std::nullopt);
}

TEST(ADifferenceInCount, EndsWhatIsDecidedAlsoWhereTheOtherRunHasOneMoreAtTheEnd) {
  const Result run = two_contacts({});
  Result other = run;
  EXPECT_EQ(first_unresolved(run, other, 1.0), std::nullopt);
  other.sub_impacts.push_back(contact(400 * us, 450 * us));
  EXPECT_EQ(first_unresolved(run, other, 1.0), 2u);
  EXPECT_EQ(first_unresolved(other, run, 1.0), 2u);
}

TEST(AContact, ThatOnlyOneOfTwoRunsEndsIsNotDecided) {
  const Result run = two_contacts({});
  Result other = run;
  other.sub_impacts.back().end.reset();
  EXPECT_EQ(first_unresolved(run, other, 1.0), 1u);
  EXPECT_EQ(first_unresolved(other, run, 1.0), 1u);
  EXPECT_EQ(first_unresolved(other, other, 1.0), std::nullopt);
  Result judged = run;
  set_error_bars(judged, {compare_events(run, other, "mesh", "", 1.0)});
  EXPECT_EQ(
      judged.error_estimate->reason,
      "sub-impact 2 ends at 300 us in this run and lasts to the end in the run compared with");
}

TEST(TheErrorsOfTwoParts, AddUpAtANearMiss) {
  const auto with_margin = [](double margin) {
    return two_contacts({{50 * us, margin, NearMissKind::opening}});
  };
  Result run = with_margin(1.0 * um);
  const Result other = with_margin(1.6 * um);
  set_error_bars(run, {compare_events(run, other, "time", "", 1.0),
                       compare_events(run, other, "mesh", "", 1.0)});
  EXPECT_EQ(run.error_estimate->first_unresolved, 0u);
  EXPECT_EQ(run.error_estimate->parts[0].first_unresolved, std::nullopt);
}

}  // namespace
}  // namespace subimpact
