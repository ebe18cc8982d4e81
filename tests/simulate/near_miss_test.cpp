// Near misses whose times and margins are known in closed form.

#include "lumped.h"
#include "testing.h"

namespace subimpact {
namespace {

// A target on a spring and a striker of ten times its mass that stay in contact through a linear
// spring: the indentation is the sum of two sines.
struct TwoSprings {
  double target_mass = 1.0, striker_mass = 10.0, spring = 1.0e6, contact_stiffness = 3.0e6;
  double velocity = 1.0;

  StruckBeam make(bool in_modes) const {
    Scene scene;
    scene.beam.length = scene.beam.width = scene.beam.thickness = 1.0;
    scene.beam.density = target_mass;
    scene.striker = {
        .mass = striker_mass, .nose_radius = 0.5, .velocity = velocity, .position = 0.5};
    scene.contact.kind = ContactKind::linear;
    scene.contact.stiffness = contact_stiffness;
    std::unique_ptr<BeamMesh> mesh = std::make_unique<LumpedMesh>(target_mass);
    if (in_modes) mesh = std::make_unique<ModalMesh>(std::move(mesh), spring);
    return struck_beam_of(scene, std::move(mesh), SectionField(1, spring));
  }

  // Amplitudes and frequencies of the two sines.
  std::array<double, 2> frequency{}, amplitude{};
  TwoSprings() {
    const double a = (spring + contact_stiffness) / target_mass;
    const double b = -contact_stiffness / std::sqrt(target_mass * striker_mass);
    const double d = contact_stiffness / striker_mass;
    for (const int i : {0, 1}) {
      const double root = std::sqrt(0.25 * (a - d) * (a - d) + b * b);
      const double squared = 0.5 * (a + d) + (i == 0 ? -root : root);
      const double size = std::hypot(b, squared - a);
      const double of_target = b / size;
      const double of_striker = (squared - a) / size;
      const double rate = of_striker * std::sqrt(striker_mass) * velocity;
      frequency[i] = std::sqrt(squared);
      amplitude[i] = (of_striker / std::sqrt(striker_mass) - of_target / std::sqrt(target_mass)) *
                     rate / frequency[i];
    }
  }
  double indentation(double t) const {
    return amplitude[0] * std::sin(frequency[0] * t) + amplitude[1] * std::sin(frequency[1] * t);
  }
  double rate(double t) const {
    return amplitude[0] * frequency[0] * std::cos(frequency[0] * t) +
           amplitude[1] * frequency[1] * std::cos(frequency[1] * t);
  }

  // Local minima of the indentation before it first returns to zero.
  std::vector<NearMiss> minima() const {
    std::vector<NearMiss> list;
    const double dt = 1e-4 / frequency[1];
    double before = rate(dt);
    for (double t = 2.0 * dt; indentation(t) > 0.0; t += dt) {
      const double now = rate(t);
      if (before < 0.0 && now >= 0.0) {
        const double at = t - dt * now / (now - before);
        list.push_back({at, indentation(at), NearMissKind::opening});
      }
      before = now;
    }
    return list;
  }
};

TEST(AContactThatNearlyOpens, KeepsTimeAndMarginOfEveryNearMissByEveryMethod) {
  const TwoSprings bodies;
  const std::vector<NearMiss> expected = bodies.minima();
  ASSERT_EQ(expected.size(), 3u);
  ASSERT_GT(expected[0].margin, 0.0);
  const Way ways[] = {{"dop853", 1e-9, {}, EventHandling::located},
                      {"dop853", 1e-5, {}, EventHandling::located},
                      {"dormand-prince", 1e-9, {}, EventHandling::located},
                      {"dprkn8", 1e-9, {}, EventHandling::located},
                      {"dprkn12", 1e-9, {}, EventHandling::located},
                      {"exponential", 1e-9, {}, EventHandling::located},
                      {"dprkn8", 1e-9, 2e-5, EventHandling::interpolated},
                      {"central-difference", 1e-9, 5e-6, EventHandling::interpolated}};
  for (const Way& way : ways) {
    StruckBeam beam = bodies.make(way.in_modes());
    const Result result = run_two_bodies(beam, way, 14.0e-3);
    ASSERT_GE(result.near_misses.size(), 3u) << way.table;
    for (std::size_t i = 0; i < 3; ++i) {
      const NearMiss& found = result.near_misses[i];
      EXPECT_EQ(found.kind, NearMissKind::opening);
      const double share = way.events == EventHandling::located ? 2e-5 : 0.02;
      EXPECT_NEAR(found.margin, expected[i].margin, share * expected[i].margin) << way.table;
      EXPECT_NEAR(found.time, expected[i].time, 0.02e-3) << way.table;
    }
    // Rates where the contact begins and ends.
    const SubImpact& first = result.sub_impacts.front();
    EXPECT_NEAR(first.start_rate, bodies.velocity, 1e-9);
    EXPECT_NEAR(first.end_rate, bodies.rate(*first.end), 1e-3) << way.table;
  }
}

// A target that swings with w = A sin(omega t + phase) in front of a striker that drifts away or
// nearer with the velocity d.
TEST(ASeparationThatNearlyCloses, KeepsTimeAndMarginByEveryMethod) {
  const double omega = 1e5;
  const double amplitude = 1e-4;
  const double drift = 0.3 * amplitude * omega;
  // lambda has a maximum where A omega cos(angle) = d, the sine being negative there.
  const double angle = -std::acos(drift / (amplitude * omega));
  for (const double share : {1e-6, 1e-3, 0.1}) {
    const double margin = share * amplitude;
    const double time = 0.7 * 2.0 * std::numbers::pi / omega;
    const double phase = angle - omega * time;
    const double offset = -margin - (drift * time - amplitude * std::sin(angle));
    const State from{amplitude * std::sin(phase), offset, amplitude * omega * std::cos(phase),
                     drift};
    for (const std::string table : {"dop853", "dprkn8", "dormand-prince", "exponential"}) {
      TwoBodies bodies;
      bodies.target_mass = 1.0;
      bodies.spring = omega * omega;
      bodies.contact_stiffness = 1e3;
      bodies.velocity = drift;
      const Way way{table, 1e-11, {}, EventHandling::located};
      StruckBeam beam = bodies.make(way.in_modes());
      beam.contact().set(ContactBranch::separated, {});
      const Result result = run_two_bodies(beam, way, time + 1.2 / omega, from);
      EXPECT_TRUE(result.sub_impacts.empty());
      ASSERT_EQ(result.near_misses.size(), 1u) << table << " " << share;
      const NearMiss& found = result.near_misses.front();
      EXPECT_EQ(found.kind, NearMissKind::closing);
      EXPECT_NEAR(found.margin, margin, 2e-5 * margin + 1e-10 * amplitude) << table;
      // The cubic of a step: those of the exponential method are the longest.
      EXPECT_NEAR(found.time, time, (table == "exponential" ? 1e-2 : 1e-3) / omega) << table;
    }
  }
}

// Far longer than its minima: the nearest are kept, and they are bounded in number.
TEST(NearMisses, OfOneSeparationAreTheNearestFewInOrderOfTime) {
  TwoBodies bodies;
  bodies.target_mass = 1.0;
  bodies.spring = 1e10;
  bodies.contact_stiffness = 1e3;
  bodies.velocity = 1.0;
  StruckBeam beam = bodies.make();
  beam.contact().set(ContactBranch::separated, {});
  // Fifty periods; each maximum of lambda is 6.28 um nearer than the one before it.
  const double omega = 1e5;
  const double period = 2.0 * std::numbers::pi / omega;
  const double drift = 0.1;
  const State from{0.0, -1e-4 - 51.0 * drift * period, 1e-4 * omega, drift};
  const Result result =
      run_two_bodies(beam, {"dop853", 1e-11, {}, EventHandling::located}, 50.0 * period, from);
  EXPECT_TRUE(result.sub_impacts.empty());
  ASSERT_EQ(result.near_misses.size(), 8u);
  for (std::size_t i = 1; i < 8; ++i) {
    EXPECT_NEAR(result.near_misses[i].time - result.near_misses[i - 1].time, period, 1e-3 * period);
    EXPECT_NEAR(result.near_misses[i - 1].margin - result.near_misses[i].margin, drift * period,
                0.05 * drift * period);
  }
}

}  // namespace
}  // namespace subimpact
