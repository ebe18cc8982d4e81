// The exponential method's parts against quadrature and closed forms.

#include "integrate/exponential.h"
#include "integrate/oscillator_step.h"
#include "order_table.h"

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
  return std::sqrt(std::transform_reduce(a.begin(), a.end(), b.begin(), 0.0, std::plus<>(),
                                         [](double x, double y) { return (x - y) * (x - y); }));
}

TEST(TheExponentialMethod, IsOfOrderEightAtStepEndsOfASmoothForce) {
  // Collocation at four Gauss points.
  const double end = 2.0;
  const State exact = integrate_pair({1e-8, end / 512.0, {}}, end);
  OrderTable table("error over steps");
  for (const int n : {8, 16, 32}) {
    table.add(n, distance(integrate_pair({1e-8, end / n, {}}, end), exact));
  }
  table.expect_every_order_within(7.3, 8.7);
}

TEST(TheExponentialMethod, HoldsItsTolerance) {
  const State exact = integrate_pair({1e-8, 2.0 / 512.0, {}}, 2.0);
  double previous = 1.0;
  for (const double rtol : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const double error = distance(integrate_pair({rtol, {}, {}}, 2.0), exact);
    EXPECT_LT(error, std::min(10.0 * rtol, previous)) << rtol;
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
}

// Damped oscillators in closed form, against high-order integration in small steps.

constexpr std::size_t n_powers = DampedOscillator::n_powers;
using Powers = std::array<double, n_powers>;

// q, q' and the integral of q'^2, by the classical Runge-Kutta method extrapolated.
struct Motion {
  double q, v, squares;
};

Motion rate(double omega, double delta, const Powers& f, double t, const Motion& m) {
  const double force = f[0] + t * (f[1] + t * (f[2] / 2.0 + t * f[3] / 6.0));
  return {m.v, force - 2.0 * delta * m.v - omega * omega * m.q, m.v * m.v};
}

Motion plus(const Motion& a, double h, const Motion& b) {
  return {a.q + h * b.q, a.v + h * b.v, a.squares + h * b.squares};
}

Motion integrate(double omega, double delta, const Powers& f, Motion m, double end, int n) {
  const double h = end / n;
  for (int i = 0; i < n; ++i) {
    const double t = i * h;
    const Motion a = rate(omega, delta, f, t, m);
    const Motion b = rate(omega, delta, f, t + 0.5 * h, plus(m, 0.5 * h, a));
    const Motion c = rate(omega, delta, f, t + 0.5 * h, plus(m, 0.5 * h, b));
    const Motion d = rate(omega, delta, f, t + h, plus(m, h, c));
    m = plus(plus(plus(plus(m, h / 6.0, a), h / 3.0, b), h / 3.0, c), h / 6.0, d);
  }
  return m;
}

Motion reference(double omega, double delta, const Powers& f, const Motion& start, double end) {
  const int n = 16000;
  const Motion coarse = integrate(omega, delta, f, start, end, n);
  const Motion fine = integrate(omega, delta, f, start, end, 2 * n);
  return plus(fine, 1.0 / 15.0,
              {fine.q - coarse.q, fine.v - coarse.v, fine.squares - coarse.squares});
}

// omega, delta: far below, near and beyond critical damping, and bodies without a spring.
constexpr double oscillators[][2] = {{3.0, 0.0},   {3.0, 0.03},  {0.2, 0.002}, {0.5, 0.4},
                                     {3.0, 2.999}, {3.0, 3.0},   {3.0, 3.01},  {0.1, 0.7},
                                     {2.0, 9.0},   {0.3, 6.0},   {0.0, 0.01},  {0.0, 0.8},
                                     {0.0, 4.0},   {0.01, 40.0}, {20.0, 0.2},  {0.0, 0.0}};

TEST(ADampedOscillator, MovesAsItsEquationSaysAndHasTheIntegralOfItsSquaredVelocity) {
  const Powers f{0.7, -0.4, 0.9, -1.3};
  const Motion start{0.3, -0.8, 0.0};
  for (const auto& [omega, delta] : oscillators) {
    for (const double t : {0.01, 0.6, 1.0, 2.5}) {
      const Motion expected = reference(omega, delta, f, start, t);
      const DampedOscillator at(omega, delta, t);
      double q = at.position * start.q + at.response * start.v + f[0] * at.forced[0];
      double v = -omega * omega * at.response * start.q + at.slope * start.v + f[0] * at.response;
      for (std::size_t m = 1; m < n_powers; ++m) {
        q += f[m] * at.forced[m];
        v += f[m] * at.forced[m - 1];
      }
      EXPECT_NEAR(q, expected.q, 1e-11) << omega << ' ' << delta << ' ' << t;
      EXPECT_NEAR(v, expected.v, 1e-11 * std::max(1.0, omega)) << omega << ' ' << delta << ' ' << t;
      const double squares = integral_of_squared_velocity(omega, delta, start.q, start.v, f, t);
      EXPECT_NEAR(squares, expected.squares, 1e-10 * expected.squares)
          << omega << ' ' << delta << ' ' << t;
    }
  }
}

// A mode far beyond critical damping, as stiffness damping makes the highest ones: from the balance
// of energy, 4 delta times the integral is the loss of v^2 + omega^2 q^2.
TEST(AnOscillatorFarBeyondCriticalDamping, LosesTheEnergyThatItsSquaredVelocitySays) {
  const Powers none{};
  for (const auto& [omega, delta] : {std::pair(3.8e6, 7e8), {3.8e6, 7e9}, {2e5, 2e6}, {7.0, 7e4}}) {
    for (const double t : {0.3, 3.0, 40.0, 4000.0}) {
      const double time = t / delta;
      const double q = 2e-9, v = 0.3 * delta * q;
      const DampedOscillator at(omega, delta, time);
      const double q1 = at.position * q + at.response * v;
      const double v1 = -omega * omega * at.response * q + at.slope * v;
      const double loss = v * v - v1 * v1 + omega * omega * (q - q1) * (q + q1);
      const double here = integral_of_squared_velocity(omega, delta, q, v, none, time);
      EXPECT_NEAR(4.0 * delta * here, loss, 1e-11 * loss) << omega << ' ' << delta << ' ' << t;
    }
  }
}

}  // namespace
}  // namespace subimpact
