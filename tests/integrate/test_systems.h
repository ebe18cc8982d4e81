#pragma once

#include "ode/integrator.h"
#include "ode/second_order_ode.h"
#include "order_table.h"

namespace subimpact {

/// A problem whose motion is known at every time.
template <class Ode>
class Known : public Ode {
 public:
  virtual State exact(double t) const = 0;
  State initial() const { return exact(0.0); }

  /// Largest difference to the exact state, in the problem's own scales.
  double error(double t, const State& y) const {
    const State right = exact(t);
    const std::size_t n = right.size() / 2;
    double largest = 0.0;
    for (std::size_t i = 0; i < right.size(); ++i) {
      const double unit = i < n ? this->scales().position : this->scales().velocity;
      largest = std::fmax(largest, std::abs(y[i] - right[i]) / unit);
    }
    return largest;
  }
};

using KnownMotion = Known<SecondOrderOde>;

inline double largest_difference(const State& a, const State& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// The largest error of n steps up to `end`, at the part `place` of each; infinite if the motion
/// with such steps grows out of hand, or Newton's iteration fails.
template <class Method, class Motion>
double error_in_steps(const Method& method, Motion& motion, double end, int n, double place) try {
  const auto integrator = method.with_step(motion, end / n);
  integrator->restart(0.0, motion.initial());
  double largest = 0.0;
  State inside;
  for (int i = 0; i < n; ++i) {
    integrator->step();
    const double t = place < 1.0 ? integrator->start_time() + place * end / n : integrator->time();
    if (place < 1.0) {
      integrator->state_at(t, inside);
    } else {
      inside = integrator->state();
    }
    largest = std::max(largest, motion.error(t, inside));
  }
  return largest;
} catch (const IntegrationFailure&) {
  return std::numeric_limits<double>::infinity();
}

/// Where errors are neither too coarse to be asymptotic nor rounding.
struct Asymptotic {
  int first_third;           ///< of doublings of one step
  double largest, smallest;  ///< errors
  std::size_t most_rows = 100;
};

/// `error_of(n)` is the error with n steps; n grows by the cube root of 2, and the order over the
/// last doubling lies within [low, high].
template <class ErrorOf>
void expect_finest_order(double low, double high, const Asymptotic& range, ErrorOf error_of) {
  OrderTable table("largest error over steps");
  for (int thirds = range.first_third; thirds < 45 && table.size() < range.most_rows; ++thirds) {
    const auto n = static_cast<int>(std::lround(std::pow(2.0, thirds / 3.0)));
    const double error = error_of(n);
    if (!(error < range.largest)) continue;
    if (error < range.smallest) break;
    table.add(n, error);
  }
  table.print();
  table.expect_finest_order_within(4, low, high);
}

/// A chain of n unit masses between two walls, joined by unit springs, time sped up by `rate`: all
/// modes k = 1..n are excited, each with its own phase. omega_k = 2 rate sin(k pi/(2(n + 1))).
class SpringChain final : public KnownMotion {
 public:
  explicit SpringChain(std::size_t n, double rate = 1.0) : n_(n), rate_(rate) {}

  std::size_t n_positions() const override { return n_; }
  Scales scales() const override { return {1.0, rate_}; }
  void acceleration(std::span<const double> q, std::span<double> a) override {
    for (std::size_t i = 0; i < n_; ++i) {
      const double left = i > 0 ? q[i - 1] : 0.0;
      const double right = i + 1 < n_ ? q[i + 1] : 0.0;
      a[i] = rate_ * rate_ * (left - 2.0 * q[i] + right);
    }
  }
  State exact(double t) const override {
    State y(2 * n_, 0.0);
    for (std::size_t k = 1; k <= n_; ++k) {
      const double phase = static_cast<double>(k * k);
      const double omega = frequency(k);
      for (std::size_t i = 0; i < n_; ++i) {
        const double shape =
            std::sin(static_cast<double>(k * (i + 1)) * std::numbers::pi / denominator()) /
            static_cast<double>(n_);
        y[i] += shape * std::cos(omega * t + phase);
        y[n_ + i] -= omega * shape * std::sin(omega * t + phase);
      }
    }
    return y;
  }
  double frequency(std::size_t k) const {
    return 2.0 * rate_ * std::sin(0.5 * static_cast<double>(k) * std::numbers::pi / denominator());
  }

 private:
  double denominator() const { return static_cast<double>(n_ + 1); }
  std::size_t n_;
  double rate_;
};

/// Jacobi's elliptic functions of parameter m = k^2, by descending Landen transformations.
struct Elliptic {
  double sn, cn, dn;
  Elliptic(double u, double m) {
    double a[16], c[16];
    a[0] = 1.0;
    c[0] = std::sqrt(m);
    double b = std::sqrt(1.0 - m);
    int n = 0;
    while (n < 15 && std::abs(c[n]) > 1e-17) {
      a[n + 1] = 0.5 * (a[n] + b);
      c[n + 1] = 0.5 * (a[n] - b);
      b = std::sqrt(a[n] * b);
      ++n;
    }
    double phase = std::ldexp(a[n] * u, n);
    for (; n > 0; --n) phase = 0.5 * (phase + std::asin(c[n] / a[n] * std::sin(phase)));
    sn = std::sin(phase);
    cn = std::cos(phase);
    dn = std::sqrt(1.0 - m * sn * sn);
  }
};

/// Three nonlinear oscillators of known motion, mixed by a rotation, so that each position feels
/// all of them: s'' = -s - s^3 has cn(sqrt(2) t | 1/4), s'' = -s^3 has cn(t | 1/2) and s'' = -1.3 s
/// + 0.6 s^3 has sn(t | 0.3).
class CurvedMotion final : public KnownMotion {
 public:
  std::size_t n_positions() const override { return 3; }
  Scales scales() const override { return {1.0, 1.0}; }
  void acceleration(std::span<const double> q, std::span<double> a) override {
    const Triple s = unmix({q[0], q[1], q[2]});
    const Triple mixed = mix(
        {-s[0] - s[0] * s[0] * s[0], -s[1] * s[1] * s[1], -1.3 * s[2] + 0.6 * s[2] * s[2] * s[2]});
    std::copy(mixed.begin(), mixed.end(), a.begin());
  }
  State exact(double t) const override {
    const double rate = std::numbers::sqrt2;
    const Elliptic hard(rate * t, 0.25);
    const Elliptic cubic(t, 0.5);
    const Elliptic soft(t, 0.3);
    const Triple q = mix({hard.cn, cubic.cn, soft.sn});
    const Triple v = mix({-rate * hard.sn * hard.dn, -cubic.sn * cubic.dn, soft.cn * soft.dn});
    return {q[0], q[1], q[2], v[0], v[1], v[2]};
  }

 private:
  using Triple = std::array<double, 3>;
  // An orthogonal matrix with entries of like size.
  static constexpr double rotation[3][3] = {{2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0},
                                            {2.0 / 3.0, 2.0 / 3.0, -1.0 / 3.0},
                                            {-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0}};
  static Triple mix(const Triple& s) {
    Triple q{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) q[i] += rotation[i][j] * s[j];
    }
    return q;
  }
  static Triple unmix(const Triple& q) {
    Triple s{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) s[j] += rotation[i][j] * q[i];
    }
    return s;
  }
};

/// Whatever acceleration a test wants.
class AnyMotion final : public SecondOrderOde {
 public:
  using Acceleration = std::function<void(std::span<const double>, std::span<double>)>;
  AnyMotion(std::size_t n, Acceleration acceleration)
      : n_(n), acceleration_(std::move(acceleration)) {}
  std::size_t n_positions() const override { return n_; }
  Scales scales() const override { return {1.0, 1.0}; }
  void acceleration(std::span<const double> q, std::span<double> a) override {
    acceleration_(q, a);
  }

 private:
  std::size_t n_;
  Acceleration acceleration_;
};

}  // namespace subimpact
