// The exponential method's parts against quadrature and closed forms.

#include "integrate/exponential.h"
#include "testing.h"

namespace subimpact {
namespace {

// A body and an oscillator with a spring between them that stiffens: F = k lambda + c lambda^3.
class Pair final : public ForcedOscillators {
 public:
  std::span<const double> frequencies() const override { return frequencies_; }
  std::span<const double> loads() const override { return loads_; }
  std::span<const double> displacements() const override { return displacements_; }
  Force force(double x) const override {
    if (free) return {0.0, 0.0};
    return {4.0 * x + 2.0 * x * x * x, 4.0 + 6.0 * x * x};
  }
  bool is_free() const override { return free; }
  double critical_displacement() const override { return free ? 1e3 : -1e3; }
  SecondOrderOde::Scales scales() const override { return {1.0, 1.0}; }

  bool free = false;

 private:
  std::vector<double> frequencies_{3.0, 0.0};
  std::vector<double> loads_{0.5, -1.0};
  std::vector<double> displacements_{-1.0, 1.0};
};

State integrate_pair(const IntegratorOptions& options, double end_time, bool free = false) {
  auto pair = std::make_unique<Pair>();
  pair->free = free;
  Exponential method(std::move(pair), options);
  method.restart(0.0, {0.1, -0.2, 0.3, 1.0});
  while (method.time() < end_time) method.step();
  State y;
  method.state_at(end_time, y);
  return y;
}

double distance(const State& a, const State& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

TEST(TheExponentialMethod, IsOfOrderEightAtStepEndsOfASmoothForce) {
  // Collocation at four Gauss points.
  const double end = 2.0;
  const State exact = integrate_pair({1e-8, end / 512.0, {}}, end);
  double previous = 0.0;
  for (const int n : {8, 16, 32}) {
    const double error = distance(integrate_pair({1e-8, end / n, {}}, end), exact);
    const double order = previous > 0.0 ? std::log2(previous / error) : 8.0;
    printf("%3d steps: error %.2e, order %.2f\n", n, error, order);
    EXPECT_GT(order, 7.3);
    EXPECT_LT(order, 8.7);
    previous = error;
  }
}

TEST(TheExponentialMethod, HoldsItsTolerance) {
  const State exact = integrate_pair({1e-8, 2.0 / 512.0, {}}, 2.0);
  double previous = 1.0;
  for (const double rtol : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const double error = distance(integrate_pair({rtol, {}, {}}, 2.0), exact);
    printf("rtol %.0e: error %.2e\n", rtol, error);
    EXPECT_LT(error, 10.0 * rtol);
    EXPECT_LT(error, previous);
    previous = error;
  }
}

TEST(TheExponentialMethod, MovesFreeBodiesAndOscillatorsExactly) {
  const State y = integrate_pair({1e-4, 0.7, {}}, 100.0, true);
  const double w = 3.0;
  EXPECT_NEAR(y[0], 0.1 * std::cos(w * 100.0) + 0.3 / w * std::sin(w * 100.0), 1e-12);
  EXPECT_NEAR(y[1], -0.2 + 100.0, 1e-11);
  EXPECT_NEAR(y[3], 1.0, 1e-15);
}

TEST(TheExponentialMethod, HasNoStepLimitFromFrequencies) {
  // A step of 300 radians of the oscillator under a force it cannot follow stays bounded.
  const State y = integrate_pair({1e-4, 100.0, {}}, 1e5, true);
  EXPECT_LT(std::abs(y[0]), 0.2);
}

TEST(AStateInsideAStep, AgreesWithItsEnds) {
  Exponential method(std::make_unique<Pair>(), {1e-8, {}, {}});
  method.restart(0.0, {0.1, -0.2, 0.3, 1.0});
  for (int i = 0; i < 20; ++i) {
    method.step();
    State y;
    method.state_at(method.time(), y);
    EXPECT_LT(distance(y, method.state()), 1e-13);
    method.state_at(method.start_time(), y);
    EXPECT_LT(distance(y, method.start_state()), 1e-13);
  }
}

// A body under way towards others that vibrate: it may cross the critical displacement to and fro.
class Approach final : public ForcedOscillators {
 public:
  std::span<const double> frequencies() const override { return frequencies_; }
  std::span<const double> loads() const override { return loads_; }
  std::span<const double> displacements() const override { return displacements_; }
  Force force(double) const override { return {0.0, 0.0}; }
  bool is_free() const override { return true; }
  double critical_displacement() const override { return 0.0; }
  SecondOrderOde::Scales scales() const override { return {1.0, 1.0}; }

 private:
  std::vector<double> frequencies_{3.0, 17.0, 60.0, 0.0};
  std::vector<double> loads_{1.0, 1.0, 1.0, 1.0};
  std::vector<double> displacements_{1.0, 1.0, 1.0, 1.0};
};

TEST(TheExponentialMethod, CrossesTheCriticalDisplacementAtMostOnceInAStepThatEndsBeyond) {
  int n_crossings = 0;
  long n_attempts = 0;
  for (int run = 0; run < 400; ++run) {
    // Amplitudes and phases of all kinds: slow ones that reverse after the first crossing, as a
    // cubic may, fast ones from none to crossing several times.
    const double a = 0.37 * run;
    const double fast = run % 3 == 0 ? 0.0 : run % 3 == 1 ? 0.1 : 1.0;
    State y{0.3 * std::sin(a),
            fast * 0.02 * std::sin(2.3 * a),
            fast * 0.01 * std::sin(3.1 * a),
            -1.5 - 0.001 * run,
            2.0 * std::cos(1.7 * a),
            fast * 0.3 * std::cos(0.9 * a),
            fast * 0.6 * std::cos(5.3 * a),
            1.0};
    const auto lambda_of = [](const State& at) { return at[0] + at[1] + at[2] + at[3]; };
    if (lambda_of(y) > -0.05) continue;
    Exponential method(std::make_unique<Approach>(), {1e-8, {}, {}});
    method.restart(0.0, y);
    State within;
    // Up to and with the step that ends beyond.
    do {
      method.step();
      int changes = 0;
      double before = lambda_of(method.start_state());
      for (int i = 1; i <= 400; ++i) {
        const double t = method.start_time() + (method.time() - method.start_time()) * i / 400.0;
        method.state_at(t, within);
        const double now = lambda_of(within);
        if (before * now < 0.0) ++changes;
        before = now;
      }
      const bool beyond = lambda_of(method.state()) > 0.0;
      EXPECT_EQ(changes, beyond ? 1 : 0) << "run " << run;
    } while (lambda_of(method.state()) < 0.0);
    ++n_crossings;
    n_attempts += method.work().steps + method.work().rejected_steps;
  }
  EXPECT_GT(n_crossings, 300);
  // Halving down to rounding at each crossing would take thirty attempts more.
  EXPECT_LT(n_attempts, 30 * n_crossings);
  printf("%d crossings, %.1f attempts each\n", n_crossings,
         static_cast<double>(n_attempts) / n_crossings);
}

}  // namespace
}  // namespace subimpact
