// Free flights: as long as possible, and never past a limit.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <utility>

#include "integrate/flying.h"

namespace subimpact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Oscillators, the first two of which move uniformly, under random guards; y holds z and its rates.
class RandomFlight final : public FreeFlight {
 public:
  explicit RandomFlight(unsigned seed) : random_(seed) {
    for (std::size_t k = 0; k + 2 < n; ++k) omega.push_back(std::pow(10.0, between(0.0, 2.0)));
    omega.resize(n, 0.0);
    std::sort(omega.begin(), omega.end());
    for (std::size_t i = 0; i < n_guards(); ++i) {
      for (std::size_t k = 0; k < n; ++k) {
        const bool uniform = omega[k] == 0.0;
        rows.push_back(uniform && i + 1 < n_guards() ? 0.0 : between(-1.0, 1.0));
      }
    }
    start.resize(2 * n);
    for (std::size_t k = 0; k < n; ++k) {
      start[k] = between(-1.0, 1.0) / (1.0 + omega[k]);
      start[n + k] = omega[k] > 0.0 ? between(-1.0, 1.0) : 0.01 * between(-1.0, 1.0);
    }
    // Limits at distances from far too near to unreachable; the start lies within.
    for (std::size_t i = 0; i < n_guards(); ++i) {
      const double swing = std::pow(10.0, between(-1.0, 1.0));
      lower.push_back(std::min(0.0, value(i, start)) - swing);
      upper.push_back(std::max(0.0, value(i, start)) + swing);
    }
    lower.back() = -infinity;
  }

  std::span<const double> frequencies() const override { return omega; }
  std::size_t n_guards() const override { return 5; }
  std::span<const double> guard(std::size_t i) const override { return {rows.data() + i * n, n}; }
  bool possible() const override { return true; }
  double outlook(const State&) override { return infinity; }
  void enter(const State& y, std::span<double> z, std::span<double> rates, std::span<double> low,
             std::span<double> high) override {
    std::copy_n(y.begin(), n, z.begin());
    std::copy_n(y.begin() + n, n, rates.begin());
    std::copy(lower.begin(), lower.end(), low.begin());
    std::copy(upper.begin(), upper.end(), high.begin());
  }
  void leave(std::span<const double> z, std::span<const double> rates, State& y) const override {
    y.assign(z.begin(), z.end());
    y.insert(y.end(), rates.begin(), rates.end());
  }

  State at(double t) const {
    State y(2 * n);
    for (std::size_t k = 0; k < n; ++k) {
      const double w = omega[k];
      const double s = w > 0.0 ? std::sin(w * t) / w : t;
      y[k] = std::cos(w * t) * start[k] + s * start[n + k];
      y[n + k] = -w * w * s * start[k] + std::cos(w * t) * start[n + k];
    }
    return y;
  }
  bool within_limits(const State& y) const {
    for (std::size_t i = 0; i < n_guards(); ++i) {
      if (!(value(i, y) > lower[i] && value(i, y) < upper[i])) return false;
    }
    return true;
  }

  static constexpr std::size_t n = 12;
  State start;
  std::vector<double> omega, rows, lower, upper;

 private:
  double between(double a, double b) { return std::uniform_real_distribution(a, b)(random_); }
  double value(std::size_t i, const State& y) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < n; ++k) sum += rows[i * n + k] * y[k];
    return sum;
  }
  std::mt19937 random_;
};

// The same motion in small exact steps: the other integrator.
class Stepper final : public Integrator {
 public:
  explicit Stepper(const RandomFlight& flight) : flight_(flight) {}
  void restart(double t, const State& y) override {
    t0_ = t1_ = t;
    y0_ = y1_ = y;
  }
  void step() override {
    t0_ = t1_;
    y0_ = y1_;
    t1_ += 1e-3;
    y1_ = flight_.at(t1_);
  }
  void state_at(double t, State& y) override { y = flight_.at(t); }
  WorkCounts work() const override { return {}; }

 private:
  const RandomFlight& flight_;
};

double distance(const State& a, const State& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::fmax(largest, std::abs(a[i] - b[i]));
  return largest;
}

TEST(AFreeFlight, NeverPassesALimitAndIsExact) {
  long flights = 0;
  double flown = 0.0;
  double total = 0.0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    auto owned = std::make_unique<RandomFlight>(seed);
    const RandomFlight& flight = *owned;
    Flying flying(std::make_unique<Stepper>(flight), std::move(owned), infinity);
    flying.restart(0.0, flight.start);
    while (flying.time() < 3.0) {
      flying.step();
      if (!flight.within_limits(flying.state())) break;  // the other integrator got there
      total += flying.time() - flying.start_time();
      if (!flying.is_eventless()) continue;
      ++flights;
      flown += flying.time() - flying.start_time();
      const double end = std::min(flying.time(), flying.start_time() + 5.0);
      for (double t = flying.start_time(); t < end; t += 1e-3) {
        State y;
        flying.state_at(t, y);
        ASSERT_LT(distance(y, flight.at(t)), 1e-11) << "seed " << seed;
        ASSERT_TRUE(flight.within_limits(y)) << "seed " << seed << ", t " << t;
      }
      ASSERT_LT(distance(flying.state(), flight.at(flying.time())), 1e-10);
    }
  }
  printf("%ld flights, %.1f %% of the time flown\n", flights, 100.0 * flown / total);
  EXPECT_GT(flights, 400);
  EXPECT_GT(flown, 0.5 * total);
}

TEST(AFreeFlight, ThatNothingLimitsGoesOnForThousandsOfSteps) {
  auto owned = std::make_unique<RandomFlight>(7);
  RandomFlight& flight = *owned;
  std::fill(flight.lower.begin(), flight.lower.end(), -1e3);
  std::fill(flight.upper.begin(), flight.upper.end(), 1e3);
  Flying flying(std::make_unique<Stepper>(flight), std::move(owned), infinity);
  flying.restart(0.0, flight.start);
  while (!flying.is_eventless()) flying.step();
  EXPECT_GT(flying.time() - flying.start_time(), 10.0);
}

TEST(AFreeFlight, IsNoLongerThanTheLargestStepAskedFor) {
  auto owned = std::make_unique<RandomFlight>(7);
  RandomFlight& flight = *owned;
  std::fill(flight.upper.begin(), flight.upper.end(), 1e3);
  std::fill(flight.lower.begin(), flight.lower.end(), -1e3);
  Flying flying(std::make_unique<Stepper>(flight), std::move(owned), 0.25);
  flying.restart(0.0, flight.start);
  while (!flying.is_eventless()) flying.step();
  EXPECT_NEAR(flying.time() - flying.start_time(), 0.25, 1e-15);
}

}  // namespace
}  // namespace subimpact
