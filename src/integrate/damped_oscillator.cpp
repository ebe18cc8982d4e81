#include "integrate/damped_oscillator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "numerics/gauss.h"

namespace subimpact {
namespace {

constexpr int n_powers = DampedOscillator::n_powers;

// Below this angle omega t the series serves, which converges fast for delta t up to the next
// number; beyond that the oscillator is overdamped, and a time is reached by doubling shorter ones.
constexpr double small_angle = 1.0;
constexpr double most_decay_of_series = 2.0;
constexpr int n_terms = 40;
constexpr double negligible = 1e-18;
constexpr auto inverse_factorials = [] {
  std::array<double, n_terms + n_powers + 2> inverse{};
  double factorial = 1.0;
  for (std::size_t j = 0; j < inverse.size(); ++j) {
    inverse[j] = 1.0 / factorial;
    factorial *= static_cast<double>(j + 1);
  }
  return inverse;
}();

// Panels of a five-point rule, exact for the square of a polynomial of degree 4, per radian; the
// rule's error is then below 1e-12 of the integral.
constexpr double panels_per_radian = 4.0;
constexpr double least_panels = 2.0;
constexpr double most_panels = 400.0;
// Roots of the characteristic equation closer than this part of their size are taken for a double
// root, whose partial fractions cancel.
constexpr double near_double_root = 1e-3;

using Complex = std::complex<double>;

double by_quadrature(double omega, double delta, double q, double v,
                     std::span<const double, n_powers> force, double t) {
  const double radians = std::max(omega, 2.0 * delta) * t;
  const double n = std::min(least_panels + std::ceil(panels_per_radian * radians), most_panels);
  const double h = t / n;
  const auto after = [&](double x) { return DampedOscillator(omega, delta, x * h); };
  const auto& points = gauss<5>.points;
  const std::array within = {after(points[0]), after(points[1]), after(points[2]),
                             after(points[3]), after(points[4]), after(1.0)};
  std::array<double, n_powers> f;  // from the start of a panel
  std::ranges::copy(force, f.begin());
  double sum = 0.0;
  for (double panel = 0.0; panel < n; panel += 1.0) {
    double rate = 0.0;
    for (std::size_t i = 0; i < within.size(); ++i) {
      const DampedOscillator& at = within[i];
      rate = at.slope * v - omega * omega * at.response * q + f[0] * at.response;
      for (std::size_t m = 1; m < n_powers; ++m) rate += f[m] * at.forced[m - 1];
      if (i < points.size()) sum += gauss<5>.weights[i] * rate * rate;
    }
    q = within.back().position * q + within.back().response * v;
    for (std::size_t m = 0; m < n_powers; ++m) q += f[m] * within.back().forced[m];
    v = rate;
    for (std::size_t m = 0; m < n_powers; ++m) {
      double power = 1.0;
      for (std::size_t k = m + 1; k < n_powers; ++k) {
        power *= h / static_cast<double>(k - m);
        f[m] += power * f[k];
      }
    }
  }
  return h * sum;
}

// An overdamped oscillator decays at two rates, fast + slow = 2 delta and fast slow = omega^2. From
// this product of the one and t on, and up to that of the other, the terms below are few.
constexpr double least_fast_decay = 4.0;
constexpr double most_slow_decay = 0.25;
constexpr std::size_t n_slow_terms = 13;

// w = q' + slow q and z = q' + fast q obey w' = f - fast w and z' = f - slow z, and
//
//     q' = (fast w - slow z)/(fast - slow) = A e^(-fast tau) + sum_k s_k tau^k/k!
//
// with the polynomial of w, w_k = (f_k - w_(k+1))/fast, and the series of z, z_(k+1) = f_k - slow
// z_k. All integrals are taken over x = tau/t.
double by_two_rates(double fast, double slow, double q, double v,
                    std::span<const double, n_powers> force, double t) {
  constexpr std::size_t n = n_slow_terms;
  std::array<double, n + 1> w{};
  for (std::size_t k = n_powers; k-- > 0;) w[k] = (force[k] - w[k + 1]) / fast;
  std::array<double, n> smooth{};  // s_k t^k/k!
  double z = v + fast * q;
  double power = 1.0;
  for (std::size_t k = 0; k < n; ++k) {
    smooth[k] = power * (fast * w[k] - slow * z) / (fast - slow);
    z = (k < n_powers ? force[k] : 0.0) - slow * z;
    power *= t / static_cast<double>(k + 1);
  }
  const double transient = fast * (v + slow * q - w[0]) / (fast - slow);
  const double decay = fast * t;
  double sum = -transient * transient * std::expm1(-2.0 * decay) / (2.0 * decay);
  double moment = -std::expm1(-decay) / decay;  // of e^(-fast tau) and x^k
  for (std::size_t k = 0; k < n; ++k) {
    if (k > 0) moment = (static_cast<double>(k) * moment - std::exp(-decay)) / decay;
    sum += 2.0 * transient * smooth[k] * moment;
    for (std::size_t i = 0; i < n; ++i) {
      sum += smooth[k] * smooth[i] / static_cast<double>(i + k + 1);
    }
  }
  return t * sum;
}

// The integral from 0 to t of z^2 e^(2 r tau) + 2 z e^(r tau) sum_m c_m tau^m; |r t| is not small.
double integral_with(Complex z, Complex r, std::span<const double, 3> c, double t) {
  const Complex over_r = std::conj(r) / std::norm(r);
  const Complex e = std::exp(r * t);
  const Complex moment0 = (e - 1.0) * over_r;  // of e^(r tau) tau^m
  const Complex moment1 = (t * e - moment0) * over_r;
  const Complex moment2 = (t * t * e - 2.0 * moment1) * over_r;
  const Complex moments = c[0] * moment0 + c[1] * moment1 + c[2] * moment2;
  return (z * (2.0 * moments + 0.5 * z * (e * e - 1.0) * over_r)).real();
}

}  // namespace

DampedOscillator::DampedOscillator(double omega, double delta, double t) {
  const double y = omega * t;
  const double d = delta * t;
  if (y < small_angle && d > most_decay_of_series) {
    *this = DampedOscillator(omega, delta, 0.5 * t).continued(omega, 0.5 * t);
    return;
  }
  if (y < small_angle) {
    // response = sum_j a_j t/(j + 1)!, a_j = -2 d a_(j-1) - y^2 a_(j-2).
    double before = 0.0;
    double a = 1.0;
    double sums[n_powers + 2] = {};
    for (int j = 0; j < n_terms; ++j) {
      const double* const inverse = inverse_factorials.data() + j;
      for (int k = 0; k < n_powers + 2; ++k) sums[k] += a * inverse[k];  // a_j/(j + k)!
      if ((std::abs(a) + std::abs(before)) * inverse[0] < negligible) break;
      const double next = -2.0 * d * a - y * y * before;
      before = a;
      a = next;
    }
    slope = sums[0];
    response = t * sums[1];
    double power = t;
    for (int m = 0; m < n_powers; ++m) {
      power *= t;
      forced[m] = power * sums[m + 2];
    }
    position = slope + 2.0 * delta * response;
    return;
  }
  const double under = omega * omega - delta * delta;
  if (under >= 0.0) {
    const double w = std::sqrt(under);
    const double decay = std::exp(-d);
    const double x = w * t;
    response = decay * (x > 0.0 ? std::sin(x) / w : t);
    slope = decay * std::cos(x) - delta * response;
  } else {
    const double s = std::sqrt(-under);
    const double fast = delta + s;
    const double slow = omega * omega / fast;  // delta - s without cancellation
    const double e_slow = std::exp(-slow * t);
    const double e_fast = std::exp(-fast * t);
    response = -e_slow * std::expm1(-2.0 * s * t) / (2.0 * s);
    slope = (fast * e_fast - slow * e_slow) / (2.0 * s);
  }
  position = slope + 2.0 * delta * response;
  double power = 1.0;  // t^m/m!
  double last = response;
  double before = slope;
  for (int m = 0; m < n_powers; ++m) {
    forced[m] = (power - 2.0 * delta * last - before) / (omega * omega);
    before = last;
    last = forced[m];
    power *= t / (m + 1);
  }
}

DampedOscillator DampedOscillator::continued(double omega, double t) const {
  DampedOscillator twice = *this;
  const double squared = omega * omega;
  twice.position = position * position - squared * response * response;
  twice.response = response * (position + slope);
  twice.slope = slope * slope - squared * response * response;
  for (int m = 0; m < n_powers; ++m) {
    // The second half begins where the first ends, under the force (t + tau)^m/m!.
    double sum = position * forced[m] + response * (m == 0 ? response : forced[m - 1]);
    double power = 1.0;  // t^k/k!
    for (int k = 0; k <= m; ++k) {
      sum += power * forced[m - k];
      power *= t / (k + 1);
    }
    twice.forced[m] = sum;
  }
  return twice;
}

double integral_of_squared_velocity(double omega, double delta, double q, double v,
                                    std::span<const double, n_powers> force, double t) {
  const Complex root = std::sqrt(Complex(delta * delta - omega * omega));
  const double fast = delta + root.real();
  const double slow = omega * omega / fast;
  if (root.real() > 0.0 && fast * t >= least_fast_decay && slow * t <= most_slow_decay) {
    return by_two_rates(fast, slow, q, v, force, t);
  }
  if (omega * t < small_angle || std::abs(root) < near_double_root * omega) {
    return by_quadrature(omega, delta, q, v, force, t);
  }
  // q' = p' + z1 e^(r1 t) + z2 e^(r2 t), with p = sum_m p_m t^m/m! that satisfies the equation.
  const double squared = omega * omega;
  double p[n_powers + 2] = {};
  for (int m = n_powers - 1; m >= 0; --m) {
    p[m] = (force[static_cast<std::size_t>(m)] - 2.0 * delta * p[m + 1] - p[m + 2]) / squared;
  }
  const double c[3] = {p[1], p[2], 0.5 * p[3]};  // p' = sum_m c_m t^m
  const Complex r1 = -squared / (delta + root);
  const Complex r2 = -delta - root;
  const double q0 = q - p[0];
  const double v0 = v - p[1];
  const Complex z1 = r1 * (v0 - r2 * q0) / (r1 - r2);
  const Complex z2 = r2 * (r1 * q0 - v0) / (r1 - r2);
  double sum = 0.0;
  double power = t;
  for (int m = 0; m < 5; ++m) {  // of t^m in p'^2
    for (int i = std::max(m - 2, 0); i <= std::min(m, 2); ++i)
      sum += c[i] * c[m - i] * power / (m + 1);
    power *= t;
  }
  const double first = integral_with(z1, r1, c, t);
  // The second term of an underdamped oscillator is the conjugate of the first.
  sum += first + (root.real() == 0.0 ? first : integral_with(z2, r2, c, t));
  const double both = -2.0 * delta;  // r1 + r2
  const double integral = delta > 0.0 ? std::expm1(both * t) / both : t;
  return sum + 2.0 * (z1 * z2).real() * integral;
}

}  // namespace subimpact
