// Free oscillators under limits: no event before the horizon, and a limit close by where it ends.

#include <random>

#include "numerics/event_free_horizon.h"
#include "testing.h"

namespace subimpact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Random event functions of random oscillators, the first two of which move uniformly; only the
// last function takes part in their motion. Closed form.
struct RandomOscillators {
  static constexpr std::size_t n = 12, n_functions = 5;

  explicit RandomOscillators(unsigned seed) : random(seed) {
    for (std::size_t k = 2; k < n; ++k) omega.push_back(std::pow(10.0, between(0.0, 2.0)));
    omega.resize(n, 0.0);
    std::sort(omega.begin(), omega.end());
    for (std::size_t i = 0; i < n_functions; ++i) {
      for (std::size_t k = 0; k < n; ++k) {
        functions.push_back(omega[k] == 0.0 && i + 1 < n_functions ? 0.0 : between(-1.0, 1.0));
      }
    }
    for (std::size_t k = 0; k < n; ++k) {
      z.push_back(between(-1.0, 1.0) / (1.0 + omega[k]));
      rates.push_back(between(-1.0, 1.0) * (omega[k] > 0.0 ? 1.0 : 0.01));
    }
    // Limits at distances from far too near to unreachable; the start lies within.
    for (std::size_t i = 0; i < n_functions; ++i) {
      const double distance = std::pow(10.0, between(-1.0, 1.0));
      low.push_back(std::min(0.0, value(i, z)) - distance);
      high.push_back(std::max(0.0, value(i, z)) + distance);
    }
    low.back() = -infinity;
  }
  double horizon(double longest) {
    return EventFreeHorizon(omega, functions).from(z, rates, low, high, longest);
  }
  std::vector<double> displacements(double t) const {
    std::vector<double> at(n);
    for (std::size_t k = 0; k < n; ++k) {
      const double w = omega[k];
      at[k] = std::cos(w * t) * z[k] + (w > 0.0 ? std::sin(w * t) / w : t) * rates[k];
    }
    return at;
  }
  double value(std::size_t i, std::span<const double> at) const {
    return std::inner_product(at.begin(), at.end(), functions.data() + i * n, 0.0);
  }
  // Largest possible departure from uniform motion.
  double amplitude_bound(std::size_t i) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      if (omega[k] == 0.0) continue;
      sum += std::abs(functions[i * n + k]) * std::hypot(z[k], rates[k] / omega[k]);
    }
    return sum;
  }
  double to_nearest_limit(std::size_t i, std::span<const double> at) const {
    return std::min(high[i] - value(i, at), value(i, at) - low[i]);
  }
  // To the first sample outside limits; `end` if there is none before it.
  double first_event(double end) const {
    for (double t = 0.0; t < end; t += 1e-3) {
      const std::vector<double> at = displacements(t);
      for (std::size_t i = 0; i < n_functions; ++i) {
        if (to_nearest_limit(i, at) <= 0.0) return t;
      }
    }
    return end;
  }
  double between(double a, double b) { return std::uniform_real_distribution(a, b)(random); }

  std::mt19937 random;
  std::vector<double> omega, functions, z, rates, low, high;
};

TEST(AnEventFreeHorizon, IsNeverBeyondTheFirstEventAndCoversNineTenthsOfTheTimeToIt) {
  constexpr double longest = 5.0;
  double reached = 0.0, possible = 0.0;
  int n_events = 0;
  for (unsigned seed = 1; seed <= 300; ++seed) {
    RandomOscillators system(seed);
    const double horizon = system.horizon(longest);
    const double event = system.first_event(longest);
    ASSERT_LE(horizon, event) << "seed " << seed;
    if (event == longest) continue;
    ++n_events;
    reached += horizon;
    possible += event;
  }
  EXPECT_GT(n_events, 200);
  EXPECT_GT(reached, 0.9 * possible);
}

TEST(AnEventFreeHorizon, EndsWhereAFunctionIsWithinAHundredAndTwentyEighthOfItsAmplitudeOfALimit) {
  int n_ended = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    RandomOscillators system(seed);
    const double horizon = system.horizon(infinity);
    const double interval = 0.25 / system.omega.back();
    if (horizon > 4096 * 256 * 0.99 * interval) continue;  // nothing limits it
    ++n_ended;
    double nearest = infinity;
    for (const double t : {horizon, horizon + interval}) {
      const std::vector<double> at = system.displacements(t);
      for (std::size_t i = 0; i < RandomOscillators::n_functions; ++i) {
        nearest = std::min(nearest, system.to_nearest_limit(i, at) / system.amplitude_bound(i));
      }
    }
    ASSERT_LT(nearest, 1.0 / 128.0 + 1e-9) << "seed " << seed;
  }
  EXPECT_GT(n_ended, 200);
}

TEST(AnEventFreeHorizon, IsTheLongestAskedForWhereAmplitudesStayWithinLimits) {
  RandomOscillators system(7);
  for (std::size_t i = 0; i < RandomOscillators::n_functions; ++i) {
    system.low[i] = -1e3;
    system.high[i] = 1e3;
  }
  EXPECT_EQ(system.horizon(0.25), 0.25);
  EXPECT_EQ(system.horizon(10.0), 10.0);
  EXPECT_GT(system.horizon(infinity), 10.0);
}

TEST(AnEventFreeHorizon, FollowsUniformMotionWithoutMargin) {
  // A body approaches a limit at speed 2 from distance 3; an oscillator takes no part.
  const std::vector<double> z{0.0, 1.0}, rates{2.0, 0.0}, low{-infinity}, high{3.0};
  const double horizon = EventFreeHorizon({0.0, 50.0}, {1.0, 0.0}).from(z, rates, low, high, 9.0);
  EXPECT_LE(horizon, 1.5);
  EXPECT_GT(horizon, 1.5 - 0.25 / 50.0 - 1e-9);
}

}  // namespace
}  // namespace subimpact
