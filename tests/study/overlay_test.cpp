#include "subimpact/study/overlay.h"

#include <random>

#include "elastic_case.h"
#include "subimpact/case/simulate.h"
#include "subimpact/simulate/error.h"
#include "testing.h"

namespace subimpact {
namespace {

double value_at(const Signal& signal, double time) {
  const auto& t = signal.times;
  const auto next = std::ranges::upper_bound(t, time);
  if (next == t.begin()) return 0.0;
  if (next == t.end()) return signal.forces.back();
  const auto i = static_cast<std::size_t>(next - t.begin());
  return std::lerp(signal.forces[i - 1], signal.forces[i], (time - t[i - 1]) / (t[i] - t[i - 1]));
}

/// Butterworth's filter of fourth order another way: by its polynomial as a differential equation,
/// y''''/w^4 + 2.6131 y'''/w^3 + (2 + sqrt 2) y''/w^2 + 2.6131 y'/w + y = F, with Runge and Kutta's
/// method in small steps.
class Filter {
 public:
  Filter(const Signal& force, double cutoff)
      : force_(force), omega_(2.0 * std::numbers::pi * cutoff) {}
  double at(double time) {
    const double h = 0.004 / omega_;
    while (time_ + h <= time) step(h);
    if (time > time_) step(time - time_);
    return y_[0];
  }

 private:
  using State = std::array<double, 4>;  // y, y'/w, y''/w^2, y'''/w^3
  State rate(double t, const State& y) const {
    const double a = std::sqrt(4.0 + 2.0 * std::numbers::sqrt2), b = 2.0 + std::numbers::sqrt2;
    return {omega_ * y[1], omega_ * y[2], omega_ * y[3],
            omega_ * (value_at(force_, t) - y[0] - a * y[1] - b * y[2] - a * y[3])};
  }
  static State sum(const State& y, double h, const State& k) {
    State s;
    for (std::size_t i = 0; i < s.size(); ++i) s[i] = y[i] + h * k[i];
    return s;
  }
  void step(double h) {
    const State k1 = rate(time_, y_), k2 = rate(time_ + h / 2, sum(y_, h / 2, k1)),
                k3 = rate(time_ + h / 2, sum(y_, h / 2, k2)), k4 = rate(time_ + h, sum(y_, h, k3));
    for (std::size_t i = 0; i < y_.size(); ++i) {
      y_[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
    time_ += h;
  }

  const Signal& force_;
  double omega_, time_ = 0.0;
  State y_{};
};

const std::vector<HistoryRow>& history() {
  static const std::vector<HistoryRow> rows = [] {
    Case input = elastic_case(1.8e-3, 51);
    input.output.interval = 5e-7;
    return simulate(input).history;
  }();
  return rows;
}

Signal computed_force() {
  Signal force;
  for (const HistoryRow& row : history()) {
    force.times.push_back(row.time);
    force.forces.push_back(row.force);
  }
  return force;
}

struct Measurement {
  double shift = 0.0;   // s
  double cutoff = 0.0;  // Hz; 0: no filter
  double interval = 1e-6;
  double noise = 0.0;  // of the peak
  double factor = 1.0;
  unsigned seed = 1;
  double from = -2e-4, to = 1.8e-3;  // s, of the run
  friend void PrintTo(const Measurement& how, std::ostream* out) {
    *out << "seed " << how.seed << ", " << how.cutoff << " Hz, noise " << how.noise;
  }
};

Signal measured(const Measurement& how) {
  const Signal force = computed_force();
  Filter filter(force, how.cutoff);
  std::mt19937 random(how.seed);
  std::normal_distribution<double> noise(0.0, how.noise * std::ranges::max(force.forces));
  Signal result;
  for (double t = how.from; t <= how.to; t += how.interval) {
    const double f = t <= 0.0 ? 0.0 : how.cutoff > 0.0 ? filter.at(t) : value_at(force, t);
    result.times.push_back(t + how.shift);
    result.forces.push_back(how.factor * f + noise(random));
  }
  return result;
}

TEST(LowPass, IsTheFilterOfFourthOrderByItsDifferentialEquation) {
  const Signal force = computed_force();
  const Signal filtered = low_passed(force, 20e3);
  Filter filter(force, 20e3);
  const double largest = std::ranges::max(force.forces);
  for (std::size_t i = 0; i < force.times.size(); i += 7) {
    EXPECT_NEAR(filtered.forces[i], filter.at(force.times[i]), 1e-5 * largest) << force.times[i];
  }
}

TEST(LowPass, LosesThreeDecibelsAtTheCutoffAndTwentyFourPerOctaveAbove) {
  const double cutoff = 5e3;
  for (const auto& [frequency, expected] :
       {std::pair(cutoff / 4, 1.0 / std::hypot(1.0, std::pow(0.25, 4))),
        std::pair(cutoff, std::sqrt(0.5)), std::pair(4 * cutoff, 1.0 / std::hypot(1.0, 256.0))}) {
    Signal sine;
    for (int i = 0; i <= 40'000; ++i) {
      sine.times.push_back(1e-3 / 4000 * i);
      sine.forces.push_back(std::sin(2.0 * std::numbers::pi * frequency * sine.times.back()));
    }
    const std::vector<double> filtered = low_passed(sine, cutoff).forces;
    const double largest = std::ranges::max(std::vector(filtered.end() - 8000, filtered.end()));
    EXPECT_NEAR(largest, expected, 2e-4 * expected) << frequency;
  }
}

class OverlayOfAMeasurement : public testing::TestWithParam<Measurement> {};

TEST_P(OverlayOfAMeasurement, FindsShiftToATenthOfASampleAndTheFilter) {
  const Measurement& how = GetParam();
  const Overlay overlay =
      overlay_of(history(), measured(how), {.shift = {}, .low_pass = {}, .find_low_pass = true});
  EXPECT_NEAR(overlay.shift.value, how.shift, 0.1 * how.interval);
  EXPECT_NEAR(overlay.low_pass->value, how.cutoff, 0.01 * how.cutoff);
  EXPECT_FALSE(overlay.low_pass_at_bound);
  EXPECT_GT(overlay.correlation, 0.99);
  EXPECT_NEAR(overlay.sampling_interval, how.interval, 1e-12);
  ASSERT_TRUE(overlay.shift.error && overlay.low_pass->error);
  EXPECT_LT(std::abs(overlay.shift.value - how.shift),
            4.0 * *overlay.shift.error + 2e-3 * how.interval);
  EXPECT_LT(*overlay.shift.error, 0.1 * how.interval);
  EXPECT_LT(std::abs(overlay.low_pass->value - how.cutoff),
            4.0 * *overlay.low_pass->error + 1e-3 * how.cutoff);
}

INSTANTIATE_TEST_SUITE_P(
    , OverlayOfAMeasurement,
    testing::Values(
        Measurement{.shift = 1.2345678e-3, .cutoff = 20e3, .noise = 0.003, .seed = 1},
        Measurement{.shift = -4.4421e-4, .cutoff = 20e3, .noise = 0.003, .factor = 1.05, .seed = 2},
        Measurement{.shift = 0.7312346, .cutoff = 8e3, .interval = 2e-6, .noise = 0.003, .seed = 3},
        // The record begins after the first contact has begun and ends before the run does.
        Measurement{
            .shift = 3.21e-5, .cutoff = 50e3, .noise = 0.01, .seed = 4, .from = 5e-5, .to = 1.5e-3},
        // The record is far longer than the run: 20 ms of noise before it.
        Measurement{.shift = 2.00007e-2, .cutoff = 30e3, .noise = 0.01, .seed = 5, .from = -2e-2}),
    [](const auto& instance) { return "Seed" + std::to_string(instance.param.seed); });

TEST(Overlay, WithTheCutoffGivenFindsTheShiftAlone) {
  const Measurement how{.shift = 5.5555e-5, .cutoff = 20e3, .noise = 0.02, .seed = 6};
  const Overlay overlay =
      overlay_of(history(), measured(how), {.shift = {}, .low_pass = 20e3, .find_low_pass = false});
  EXPECT_NEAR(overlay.shift.value, how.shift, 0.1 * how.interval);
  EXPECT_EQ(overlay.low_pass->value, 20e3);
  EXPECT_FALSE(overlay.low_pass->error);
}

TEST(Overlay, StatesTheDifferenceInPeakAndImpulse) {
  const Measurement how{.shift = 3e-4, .interval = 1e-7, .factor = 1.25};
  const Overlay overlay =
      overlay_of(history(), measured(how), {.shift = 3e-4, .low_pass = {}, .find_low_pass = false});
  EXPECT_FALSE(overlay.shift.error);
  const Signal force = computed_force();
  EXPECT_NEAR(overlay.computed.peak, std::ranges::max(force.forces), 1e-9);
  EXPECT_NEAR(overlay.measured.peak / overlay.computed.peak, 1.25, 1e-4);
  EXPECT_NEAR(overlay.measured.impulse / overlay.computed.impulse, 1.25, 1e-4);
  const double struck = history().front().striker_velocity,
               after = history().back().striker_velocity;
  EXPECT_NEAR(overlay.computed.impulse, paper_scene().striker.mass * (struck - after),
              1e-3 * overlay.computed.impulse);
  EXPECT_NEAR(overlay.from, 0.0, 1e-12);
  EXPECT_NEAR(overlay.to, 1.8e-3, 2e-7);
  EXPECT_NEAR(overlay.correlation, 1.0, 1e-6);
}

TEST(Overlay, OfAnotherForceHasALowCorrelation) {
  Signal hum;
  for (int i = 0; i < 2000; ++i) {
    hum.times.push_back(1e-6 * i);
    hum.forces.push_back(100.0 * std::sin(0.02 * i));
  }
  EXPECT_LT(overlay_of(history(), hum).correlation, 0.9);
}

TEST(Overlay, RefusesWhatCannotBeLaidBesideEachOther) {
  const auto message = [](const Signal& signal, const OverlayOptions& options = {}) {
    return message_of<ResultsError>([&] { overlay_of(history(), signal, options); });
  };
  Signal signal = measured({.shift = 0.0});
  expect_in(message(signal, {.shift = 1.0, .low_pass = {}}), "no time in common");
  for (double& force : signal.forces) force = -force;
  expect_in(message(signal), "change the sign");
  EXPECT_THROW(overlay_of({}, measured({})), ResultsError);
}

}  // namespace
}  // namespace subimpact
