// Events with known answers, by the ten thousand: none missed, none invented, none twice.

#include <random>

#include "lumped.h"
#include "print.h"

namespace subimpact {
namespace {

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double between(double a, double b) { return a + (b - a) * unit_(generator_); }
  double decades(double a, double b) { return std::pow(10.0, between(a, b)); }
  template <class T>
  T one_of(const std::vector<T>& choices) {
    return choices[static_cast<std::size_t>(between(0.0, static_cast<double>(choices.size())))];
  }

 private:
  std::mt19937 generator_;
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
};

const std::vector<std::string> tables = {"dormand-prince", "dop853", "bogacki-shampine", "dprkn8",
                                         "exponential"};
const std::vector<std::string> library_methods = {"dormand-prince", "dop853", "bogacki-shampine",
                                                  "dirk:esdirk547", "adams",  "bdf"};

// Restitution of an elasto-plastic impact that reaches x = lambda_m/lambda_s, from its energies.
double restitution_at(double x) {
  return std::sqrt(1.0 -
                   std::pow(x - 1.0, 1.5) / (0.4 * (std::pow(x, 2.5) - std::pow(x - 1.0, 2.5))));
}

void expect_one_impact(int n_scenarios, const std::vector<std::string>& methods,
                       EventHandling events) {
  Random random(1);
  int wrong = 0;
  double worst_restitution = 0.0, worst_duration = 0.0;
  for (int k = 0; k < n_scenarios; ++k) {
    TwoBodies bodies;
    bodies.striker_mass = random.decades(-4, 4);
    bodies.target_mass = random.decades(-4, 4);
    bodies.contact_stiffness = random.decades(4, 12);
    bodies.velocity = random.decades(-3, 3);
    const double elastic = bodies.largest_indentation();
    const bool yields = k % 2 == 0;
    if (yields) bodies.yield_indentation = elastic * random.between(0.02, 0.9);
    const Way way{random.one_of(methods), random.decades(-9, -5), {}, events};
    StruckBeam beam = bodies.make(way.in_modes());
    const Result result = run_two_bodies(beam, way, 6.0 * bodies.duration());
    const std::size_t expected = yields ? 4 : 2;
    const bool right = result.transitions.size() == expected && result.sub_impacts.size() == 1 &&
                       result.sub_impacts[0].end.has_value() &&
                       result.transitions.front().kind == EventKind::contact_begins &&
                       result.transitions.back().kind == EventKind::contact_ends;
    if (!right) {
      if (++wrong > 5) continue;  // enough to see what they have in common
      ADD_FAILURE() << result.transitions.size() << " events in place of " << expected << ", "
                    << way.table << " rtol " << way.rtol << " m " << bodies.striker_mass << " M "
                    << bodies.target_mass << " K " << bodies.contact_stiffness << " v "
                    << bodies.velocity << " ls/d " << bodies.yield_indentation / elastic;
      continue;
    }
    const SubImpact& impact = result.sub_impacts[0];
    const double e = (result.beam_mean_velocity - result.striker_velocity) / bodies.velocity;
    const double e_exact =
        yields ? restitution_at(impact.max_indentation / bodies.yield_indentation) : 1.0;
    worst_restitution = std::max(worst_restitution, std::abs(e - e_exact));
    if (!yields) {
      worst_duration = std::max(worst_duration, std::abs(*impact.end / bodies.duration() - 1.0));
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_LT(worst_restitution, 2e-3);  // the coarsest tolerance is 1e-5
  EXPECT_LT(worst_duration, 2e-3);
}

TEST(TwoRigidBodies, MeetOnceWhateverTheirSizesAndTheMethod) {
  expect_one_impact(10000, tables, EventHandling::located);
}

TEST(TwoRigidBodies, MeetOnceWithEventsOfTheLibrary) {
  expect_one_impact(5000, library_methods, EventHandling::library);
}

// A target that swings, w = A sin(omega t + phase), and a striker that drifts towards it, so that
// the gap's first maximum at `time` exceeds zero for `duration` (negative: misses by as much).
struct Graze {
  double omega, amplitude, drift, time, duration;

  State state() const {
    const double angle = -std::acos(drift / (amplitude * omega));  // at the maximum
    const double phase = angle - omega * time;
    const double curvature = amplitude * omega * omega * std::sin(angle);  // of lambda, negative
    const double height = -0.125 * curvature * duration * std::abs(duration);
    const double offset = height - (drift * time - amplitude * std::sin(angle));
    return {amplitude * std::sin(phase), offset, amplitude * omega * std::cos(phase), drift};
  }
};

// Grazes from `shortest` (s) or `shortest_angle` (rad of the swing), the longer of the two, to a
// hundredth of a period. `from_contact`: their mirror images, contacts that open for as long.
void expect_grazes_found(int n_scenarios, const std::vector<std::string>& methods,
                         EventHandling events, double shortest, double shortest_angle,
                         bool from_contact = false) {
  Random random(2);
  int missed = 0, invented = 0, out_of_order = 0;
  for (int k = 0; k < n_scenarios; ++k) {
    Graze graze{};
    graze.omega = random.decades(4, 5.5);
    graze.amplitude = random.decades(-4, -3);
    graze.drift = graze.amplitude * graze.omega * random.between(0.02, 0.5);
    graze.time = random.between(0.3, 0.9) * 6.283 / graze.omega;
    const bool touches = k % 2 == 0;
    const double least = std::max(shortest, shortest_angle / graze.omega);
    graze.duration = (touches ? 1.0 : -1.0) *
                     std::exp(random.between(std::log(least), std::log(0.06 / graze.omega)));
    TwoBodies bodies;
    bodies.target_mass = 1.0;
    bodies.spring = graze.omega * graze.omega;
    bodies.contact_stiffness = from_contact ? 1e-6 : 1e3;  // too soft to change the motion
    bodies.velocity = graze.drift;
    const Way way{random.one_of(methods), 1e-12, {}, events};
    StruckBeam beam = bodies.make(way.in_modes());
    beam.contact().set(from_contact ? ContactBranch::elastic : ContactBranch::separated, {});
    State state = graze.state();
    for (double& x : state) x = from_contact ? -x : x;
    const Result result = run_two_bodies(beam, way, graze.time + 1.2 / graze.omega, state);
    std::size_t n_begin = 0;
    std::size_t n_end = 0;
    for (const Transition& event : result.transitions) {
      if (from_contact && event.time == 0.0) continue;
      n_begin += event.kind == EventKind::contact_begins;
      n_end += event.kind == EventKind::contact_ends;
      const std::size_t first = from_contact ? n_end : n_begin;
      const std::size_t second = from_contact ? n_begin : n_end;
      if (second > first || first > second + 1) ++out_of_order;
    }
    const std::size_t expected = touches ? 1 : 0;
    missed += n_begin < expected || n_end < expected;
    invented += n_begin > expected || n_end > expected;
  }
  EXPECT_EQ(missed, 0);
  EXPECT_EQ(invented, 0);
  EXPECT_EQ(out_of_order, 0);
}

TEST(AGraze, OfANanosecondOrMoreIsFoundAndANearMissIsNotInvented) {
  expect_grazes_found(15000, {"dop853", "dprkn8", "dprkn12", "exponential"}, EventHandling::located,
                      1e-9, 0.0);
}

// The force takes 1e4 times as long to change as the body on the spring to swing.
TEST(AnOpening, OfANanosecondOrMoreIsFoundAndANearMissIsNotInvented) {
  expect_grazes_found(8000, {"dop853", "dprkn8", "dprkn12", "exponential"}, EventHandling::located,
                      1e-9, 0.0, true);
}

// The dense output is less accurate than the method, and a graze is as deep as the square of its
// duration.
TEST(AGraze, OfAThousandthOfARadianOrMoreIsFoundByTheLibrary) {
  expect_grazes_found(5000, {"dop853", "dormand-prince", "adams", "bdf"}, EventHandling::library,
                      0.0, 1e-3);
}

// The same two bodies by a program of its own: classical Runge-Kutta with steps far below any time
// scale, crossings by bisection of the last step.
std::vector<double> bounce_times(const TwoBodies& b, std::array<double, 4> y, double end_time) {
  using Four = std::array<double, 4>;
  const auto rate = [&](const Four& s) {
    const double lambda = s[1] - s[0];
    const double force = lambda > 0.0 ? b.contact_stiffness * lambda * std::sqrt(lambda) : 0.0;
    return Four{s[2], s[3], (force - b.spring * s[0]) / b.target_mass, -force / b.striker_mass};
  };
  const auto add = [](Four a, const Four& d, double f) {
    for (std::size_t i = 0; i < 4; ++i) a[i] += f * d[i];
    return a;
  };
  const auto advance = [&](const Four& s, double h) {
    const Four k1 = rate(s);
    const Four k2 = rate(add(s, k1, 0.5 * h));
    const Four k3 = rate(add(s, k2, 0.5 * h));
    const Four k4 = rate(add(s, k3, h));
    Four r = s;
    for (std::size_t i = 0; i < 4; ++i) r[i] += h / 6.0 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    return r;
  };
  const double fine = 1e-2 * std::sqrt(b.target_mass / (b.contact_stiffness * 3e-3));
  const double coarse = 0.01 / std::sqrt(b.spring / b.target_mass);
  std::vector<double> times;
  double t = 0.0;
  while (t < end_time) {
    const bool near = y[1] - y[0] > -1.5 * coarse * std::abs(y[3] - y[2]) - 1e-9;
    const double step = near ? fine : coarse;
    const Four next = advance(y, step);
    if (y[1] - y[0] <= 0.0 && next[1] - next[0] > 0.0) {
      double a = 0.0;
      double c = step;
      for (int i = 0; i < 50; ++i) {
        const Four middle = advance(y, 0.5 * (a + c));
        (middle[1] - middle[0] > 0.0 ? c : a) = 0.5 * (a + c);
      }
      times.push_back(t + c);
    }
    y = next;
    t += step;
  }
  return times;
}

TEST(AChainOfThousandsOfBounces, LosesNoneAndRepeatsNone) {
  // A light mass on a spring swings between its spring and a heavy striker that drifts in from
  // below.
  TwoBodies bodies;
  bodies.striker_mass = 2000.0;
  bodies.target_mass = 1e-5;
  bodies.spring = 3000.0;  // 17000 rad/s
  bodies.contact_stiffness = 1e10;
  bodies.velocity = 0.02;
  const double end_time = 0.5;
  StruckBeam beam = bodies.make();
  beam.contact().set(ContactBranch::separated, {});
  const Result result = run_two_bodies(beam, {"dop853", 1e-12, {}, EventHandling::located},
                                       end_time, {1e-3, -1.2e-3, 0.0, 0.002});
  const std::vector<double> expected = bounce_times(bodies, {1e-3, -1.2e-3, 0.0, 0.002}, end_time);
  ASSERT_GT(expected.size(), 1000u);
  ASSERT_EQ(result.sub_impacts.size(), expected.size());
  double before = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(result.sub_impacts[i].start, expected[i], 1e-6);
    EXPECT_GT(result.sub_impacts[i].start, before);
    before = result.sub_impacts[i].end.value_or(HUGE_VAL);
  }
}

TEST(AStrikerThatNeverArrives, HasNoEvents) {
  TwoBodies bodies;
  StruckBeam beam = bodies.make();
  beam.contact().set(ContactBranch::separated, {});
  const Result away = run_two_bodies(beam, {}, 1.0, {0.0, -1e-3, 0.0, -1.0});
  EXPECT_TRUE(away.transitions.empty());
  StruckBeam same = bodies.make();
  same.contact().set(ContactBranch::separated, {});
  const Result alongside = run_two_bodies(same, {}, 1.0, {0.0, -1e-12, 1.0, 1.0});
  EXPECT_TRUE(alongside.transitions.empty());
  EXPECT_EQ(alongside.striker_velocity, 1.0);
}

TEST(ADeeplyPlasticImpact, AlmostSticksAndStillEndsOnce) {
  for (const double depth : {10.0, 1e2, 1e3, 1e4}) {
    TwoBodies bodies;
    bodies.yield_indentation = bodies.largest_indentation() / depth;
    StruckBeam beam = bodies.make();
    const Result result = run_two_bodies(beam, {"dop853", 1e-12, {}, EventHandling::located},
                                         50.0 * std::sqrt(depth) * bodies.duration());
    ASSERT_EQ(result.transitions.size(), 4u) << depth;
    const double x = result.max_indentation / bodies.yield_indentation;
    const double e = (result.beam_mean_velocity - result.striker_velocity) / bodies.velocity;
    EXPECT_NEAR(e, restitution_at(x), 1e-7) << depth;
  }
}

TEST(ASecondImpactBelowTheFirst, IsElasticAndShiftedByTheResidualIndentation) {
  TwoBodies bodies;
  bodies.yield_indentation = 1e-4;
  bodies.velocity = 0.2;
  StruckBeam beam = bodies.make();
  const double largest = 4e-4;
  beam.contact().set(ContactBranch::separated, {largest});
  const double residual = largest - bodies.yield_indentation;
  const Result result = run_two_bodies(beam, {}, 1e-2, {0.0, 0.0, 0.0, bodies.velocity});
  ASSERT_EQ(result.transitions.size(), 2u);
  EXPECT_NEAR(result.transitions[0].time, residual / bodies.velocity, 1e-16);
  EXPECT_NEAR(result.transitions[0].value, residual, 1e-18);
  EXPECT_NEAR(result.beam_mean_velocity - result.striker_velocity, bodies.velocity, 1e-9);
}

TEST(AnEventAtTheEndTime, IsCountedOnceAndARunJustShortOfItEndsOpen) {
  const TwoBodies bodies;
  StruckBeam beam = bodies.make();
  const double end = run_two_bodies(beam, {}, 1.0).sub_impacts.at(0).end.value();
  for (const double part : {1.0 - 1e-9, 1.0, 1.0 + 1e-9}) {
    StruckBeam again = bodies.make();
    const Result result = run_two_bodies(again, {}, part * end);
    ASSERT_EQ(result.sub_impacts.size(), 1u);
    EXPECT_LE(result.transitions.size(), 2u);
    if (part == 1.0) continue;  // either way
    EXPECT_EQ(result.sub_impacts[0].end.has_value(), part > 1.0);
    EXPECT_NEAR(result.sub_impacts[0].end.value_or(end), end, 1e-12 * end);
  }
}

}  // namespace
}  // namespace subimpact
