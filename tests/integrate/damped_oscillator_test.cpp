// Damped oscillators in closed form, against high-order integration in small steps.

#include "integrate/oscillator_step.h"

#include "testing.h"

namespace subimpact {
namespace {

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

TEST(ADampedOscillator, MovesAsItsEquationSaysUnderAPolynomialForce) {
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
    }
  }
}

TEST(ADampedOscillator, HasTheIntegralOfItsSquaredVelocity) {
  const Powers f{0.7, -0.4, 0.9, -1.3};
  const Motion start{0.3, -0.8, 0.0};
  for (const auto& [omega, delta] : oscillators) {
    for (const double t : {0.01, 0.6, 1.0, 2.5}) {
      const double expected = reference(omega, delta, f, start, t).squares;
      const double here = integral_of_squared_velocity(omega, delta, start.q, start.v, f, t);
      EXPECT_NEAR(here, expected, 1e-10 * expected) << omega << ' ' << delta << ' ' << t;
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
