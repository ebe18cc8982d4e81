// The largest gap after a contact, and contacts joined by it.

#include <numeric>

#include "lumped.h"
#include "testing.h"

namespace subimpact {
namespace {

// A striker that leaves a target of its own mass, free or on a spring.
TEST(TheOpeningAfterTheLastContact, ReachesToTheEndOfTheRun) {
  TwoBodies bodies;
  bodies.target_mass = 0.25;
  StruckBeam beam = bodies.make();
  const double end = 3.0 * bodies.duration();
  const Result result = run_two_bodies(beam, {}, end);
  ASSERT_EQ(result.sub_impacts.size(), 1u);
  const SubImpact& only = result.sub_impacts.front();
  const double apart = bodies.velocity * (end - *only.end);
  EXPECT_NEAR(*only.opening, apart, 1e-8 * apart);
}

// A light target on a spring, struck by a heavy striker: after the contact the striker moves
// uniformly and the target swings, so that the gap is known from the state as they part.
TEST(TheOpeningBeforeTheNextContact, IsTheClosedFormOfAStrikerAndASwingByEveryMethod) {
  TwoBodies bodies;
  bodies.target_mass = 0.1;
  bodies.spring = 1e5;
  const double omega = std::sqrt(bodies.spring / bodies.target_mass);
  const Way ways[] = {{"dop853", 1e-10, {}, EventHandling::located},
                      {"dormand-prince", 1e-10, {}, EventHandling::located},
                      {"dprkn8", 1e-10, {}, EventHandling::located},
                      {"exponential", 1e-10, {}, EventHandling::located},
                      {"adams", 1e-11, {}, EventHandling::located},
                      {"dop853", 1e-10, {}, EventHandling::library},
                      {"central-difference", 1e-10, 2e-7, EventHandling::interpolated}};
  for (const Way& way : ways) {
    StruckBeam beam = bodies.make(way.in_modes());
    const Result result = run_two_bodies(beam, way, 1.2 * M_PI / omega);
    ASSERT_GE(result.sub_impacts.size(), 2u) << way.table;
    const SubImpact& first = result.sub_impacts.front();
    const double v = first.striker_velocity, target = v - first.end_rate;
    const double begun = *first.end;
    // Where the target is as they part, by the energy of the three.
    const double energy = 0.5 * bodies.striker_mass * bodies.velocity * bodies.velocity -
                          0.5 * bodies.striker_mass * v * v -
                          0.5 * bodies.target_mass * target * target;
    const double w = std::sqrt(2.0 * energy / bodies.spring);
    double largest = 0.0;
    const double length = result.sub_impacts[1].start - begun;
    for (int i = 0; i <= 100000; ++i) {
      const double t = length * i / 100000.0;
      const double gap =
          w * (std::cos(omega * t) - 1.0) + target / omega * std::sin(omega * t) - v * t;
      largest = std::max(largest, gap);
    }
    const bool is_low = way.table == "central-difference";
    EXPECT_NEAR(*first.opening, largest, (is_low ? 1e-2 : 1e-4) * largest) << way.table;
  }
}

SubImpact contact(double start, double end, double impulse, double opening) {
  SubImpact s;
  s.start = start;
  s.end = end;
  s.peak_force = impulse / (end - start);
  s.peak_time = 0.5 * (start + end);
  s.impulse = s.force_integral = impulse;
  s.max_indentation = impulse;
  s.residual_indentation = 0.1 * end;
  s.striker_velocity = -end;
  s.start_rate = start;
  s.end_rate = -end;
  s.opening = opening;
  return s;
}

std::vector<SubImpact> five_contacts() {
  return {contact(0.0, 1.0, 5.0, 3e-7), contact(1.5, 2.0, 1.0, 9e-7), contact(3.0, 4.0, 2.0, 5e-6),
          contact(5.0, 6.0, 7.0, 2e-5), contact(8.0, 9.0, 3.0, 1e-9)};
}

TEST(JoinedContacts, LastFromTheFirstStartToTheLastEndWithAllThatHappenedBetween) {
  std::vector<SubImpact> all = five_contacts();
  join_sub_impacts(all, 1e-6);
  ASSERT_EQ(all.size(), 3u);
  const SubImpact& joined = all.front();
  EXPECT_EQ(joined.start, 0.0);
  EXPECT_EQ(joined.end, 4.0);
  EXPECT_EQ(joined.impulse, 8.0);
  EXPECT_EQ(joined.force_integral, 8.0);
  EXPECT_EQ(joined.peak_force, 5.0);
  EXPECT_EQ(joined.peak_time, 0.5);
  EXPECT_EQ(joined.max_indentation, 5.0);
  EXPECT_EQ(joined.residual_indentation, 0.4);
  EXPECT_EQ(joined.striker_velocity, -4.0);
  EXPECT_EQ(joined.start_rate, 0.0);
  EXPECT_EQ(joined.end_rate, -4.0);
  EXPECT_EQ(joined.opening, 5e-6);
  EXPECT_EQ(joined.inner_opening, 9e-7);
  EXPECT_FALSE(all[1].inner_opening);
}

TEST(JoiningContacts, TwiceChangesNothingAndKeepsTheImpulseAndTheCount) {
  for (const double opening : {0.0, 4e-7, 1e-6, 1e-5, 1.0}) {
    std::vector<SubImpact> once = five_contacts();
    const std::size_t n_parted = n_parted_by(opening, once);
    join_sub_impacts(once, opening);
    EXPECT_EQ(n_parted, once.size() - (*once.back().opening < opening ? 1 : 0));
    std::vector<SubImpact> twice = once;
    join_sub_impacts(twice, opening);
    ASSERT_EQ(twice.size(), once.size());
    double impulse = 0.0;
    for (std::size_t i = 0; i < once.size(); ++i) {
      EXPECT_EQ(twice[i].end, once[i].end);
      impulse += once[i].impulse;
    }
    EXPECT_EQ(impulse, 18.0);
  }
  std::vector<SubImpact> none;
  join_sub_impacts(none, 1.0);
  EXPECT_EQ(n_parted_by(1.0, none), 0u);
}

TEST(JoiningContacts, KeepsAContactThatHasNotEndedOpen) {
  std::vector<SubImpact> all = five_contacts();
  all.back().end.reset();
  all.back().opening.reset();
  EXPECT_EQ(n_parted_by(1e-9, all), 4u);
  join_sub_impacts(all, 1.0);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_FALSE(all.front().end);
  EXPECT_FALSE(all.front().opening);
  EXPECT_EQ(all.front().inner_opening, 2e-5);
}

}  // namespace
}  // namespace subimpact
