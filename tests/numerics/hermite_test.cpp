#include "numerics/hermite.h"

#include "random_walk.h"
#include "testing.h"

namespace subimpact {
namespace {

struct Cubic {
  double c0, c1, c2, c3;
  double operator()(double t) const { return c0 + t * (c1 + t * (c2 + t * c3)); }
  double rate(double t) const { return c1 + t * (2.0 * c2 + t * 3.0 * c3); }
};

HermiteCubic through(const Cubic& cubic, double t0, double step) {
  return {cubic(t0), cubic.rate(t0), cubic(t0 + step), cubic.rate(t0 + step), step};
}

TEST(HermiteCubic, ReproducesEveryCubicAndItsSlopeExactly) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::vector<double> c = random_numbers(seed, 6);
    const Cubic cubic{c[0], c[1], c[2], c[3]};
    const double t0 = c[4];
    const double step = 0.1 + std::abs(c[5]);
    const HermiteCubic path = through(cubic, t0, step);
    for (double s = 0.0; s <= 1.0; s += 0.0625) {
      EXPECT_NEAR(path(s), cubic(t0 + s * step), 4e-15 * 16.0);
      EXPECT_NEAR(path.slope(s), step * cubic.rate(t0 + s * step), 4e-15 * 16.0);
    }
  }
}

TEST(HermiteCubic, PeakIsWhereACubicsRateFallsThroughZero) {
  int n_peaks = 0;
  for (unsigned seed = 0; seed < 2000; ++seed) {
    const std::vector<double> c = random_numbers(seed, 4);
    const Cubic cubic{c[0], c[1], c[2], c[3]};
    if (!(cubic.rate(0.0) > 0.0 && cubic.rate(1.0) < 0.0)) continue;
    ++n_peaks;
    // The root of c1 + 2 c2 t + 3 c3 t^2 at which it falls, in the form that does not cancel.
    const double root = std::sqrt(c[2] * c[2] - 3.0 * c[1] * c[3]);
    const double expected = c[2] <= 0.0 ? c[1] / (-c[2] + root) : -(c[2] + root) / (3.0 * c[3]);
    EXPECT_NEAR(through(cubic, 0.0, 1.0).peak(), expected, 1e-11);
  }
  EXPECT_GT(n_peaks, 100);
}

TEST(HermiteCubic, RiseFindsTheRootOfAMonotoneCubicAnywhereInTheStep) {
  for (const double root : {1e-9, 0.01, 0.3, 0.5, 0.77, 0.999, 1.0 - 1e-9}) {
    for (const double bend : {0.0, 1.0, 30.0}) {
      // (t - root) (1 + bend (t - root)^2): rises everywhere
      const Cubic cubic{-root - bend * std::pow(root, 3), 1.0 + 3.0 * bend * root * root,
                        -3.0 * bend * root, bend};
      EXPECT_NEAR(through(cubic, 0.0, 1.0).rise(0.0, 1.0), root, 1e-12);
    }
  }
}

TEST(HermiteCubic, RisesBehindItsDipWhereItStartsAtZeroAndFalls) {
  const Cubic cubic{0.0, -0.3, 0.7, 0.2};  // t (0.2 t^2 + 0.7 t - 0.3)
  const double root = (-0.7 + std::sqrt(0.49 + 0.24)) / 0.4;
  EXPECT_NEAR(through(cubic, 0.0, 1.0).rise(0.0, 1.0), root, 1e-14);
}

TEST(HermiteCubic, RisesAtAnEndWhereRoundingLeavesNoSignChange) {
  const HermiteCubic above(1e-20, 1.0, 1.0, 1.0, 1.0);
  EXPECT_EQ(above.rise(0.0, 1.0), 0.0);
  const HermiteCubic below(-1.0, 1.0, 0.0, 1.0, 1.0);
  EXPECT_EQ(below.rise(0.0, 1.0), 1.0);
}

TEST(HermiteCubic, ExtremaAreThoseOfADenseScan) {
  int n_maxima = 0, n_reversed = 0;
  for (unsigned seed = 0; seed < 500; ++seed) {
    const std::vector<double> c = random_numbers(seed, 4);
    const HermiteCubic path = through({c[0], c[1], c[2], c[3]}, 0.0, 1.0);
    constexpr int n = 1000;
    double least = path.slope(0.0);
    bool scan_finds_maximum = false;
    for (int i = 1; i <= n; ++i) {
      const double s = static_cast<double>(i) / n;
      least = std::min(least, path.slope(s));
      scan_finds_maximum |= path.slope(s - 1.0 / n) > 1e-6 && path.slope(s) < -1e-6;
    }
    EXPECT_LE(path.least_slope(), least + 1e-14);
    EXPECT_NEAR(path.least_slope(), least, 1e-5);
    const auto maximum = path.maximum();
    if (scan_finds_maximum) {
      ASSERT_TRUE(maximum) << seed;
      EXPECT_NEAR(path.slope(*maximum), 0.0, 1e-12);
      ++n_maxima;
    }
    if (const auto reversed = path.reversed_at()) {
      EXPECT_LT(path.slope(0.0) * path.slope(*reversed), 0.0);
      EXPECT_NEAR(path.slope(path.extrema().first), 0.0, 1e-12);
      EXPECT_NEAR(path.slope(path.extrema().second), 0.0, 1e-12);
      EXPECT_LT(path.extrema().first, *reversed);
      EXPECT_GT(path.extrema().second, *reversed);
      ++n_reversed;
    }
  }
  EXPECT_GT(n_maxima, 50);
  EXPECT_GT(n_reversed, 10);
}

// sin(2 t) over a step from t0.
HermiteSeptic sine_from(double t0, double step) {
  const auto end = [](double t) -> HermiteSeptic::End {
    return {std::sin(2.0 * t), 2.0 * std::cos(2.0 * t), -4.0 * std::sin(2.0 * t),
            -8.0 * std::cos(2.0 * t)};
  };
  return {end(t0), end(t0 + step), step};
}

TEST(HermiteSeptic, IsOfOrderEight) {
  const auto error = [](double step) {
    const HermiteSeptic path = sine_from(0.3, step);
    return std::abs(path(0.5) - std::sin(2.0 * (0.3 + 0.5 * step)));
  };
  const double order = std::log2(error(0.8) / error(0.4));
  EXPECT_GT(order, 7.7);
  EXPECT_LT(order, 8.3);
}

TEST(HermiteSeptic, SlopesAreThoseOfItsValues) {
  const HermiteSeptic path = sine_from(0.1, 0.7);
  for (const double s : {0.1, 0.4, 0.8}) {
    constexpr double d = 1e-4;
    EXPECT_NEAR(path.slope(s), (path(s + d) - path(s - d)) / (2.0 * d), 1e-8);
    EXPECT_NEAR(path.second(s), (path.slope(s + d) - path.slope(s - d)) / (2.0 * d), 1e-8);
  }
}

TEST(HermiteSeptic, TurnsWhereItsSlopeVanishesWhateverTheGuess) {
  const double expected = (0.785398163397448 - 0.7) / 0.2;  // at 2 t = pi/2, t in [0.7, 0.9]
  for (const double guess : {0.0, 0.01, 0.5, expected, 1.0}) {
    const HermiteSeptic path = sine_from(0.7, 0.2);
    EXPECT_NEAR(path.slope(path.extremum(guess)), 0.0, 2e-15);
    EXPECT_NEAR(path.extremum(guess), expected, 1e-8);
  }
}

}  // namespace
}  // namespace subimpact
