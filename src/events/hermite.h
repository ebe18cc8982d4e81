#pragma once

#include <algorithm>
#include <cmath>

namespace subimpact {

/// Cubic through a value and a rate at both ends of a step, as a function of s in [0, 1]. It only
/// ever supplies first guesses: what is reported is found on the trajectory itself.
class HermiteCubic {
 public:
  HermiteCubic(double value0, double rate0, double value1, double rate1, double step)
      : c0_(value0),
        c1_(step * rate0),
        c2_(3.0 * (value1 - value0) - step * (2.0 * rate0 + rate1)),
        c3_(2.0 * (value0 - value1) + step * (rate0 + rate1)) {}

  double operator()(double s) const { return c0_ + s * (c1_ + s * (c2_ + s * c3_)); }
  double slope(double s) const { return c1_ + s * (2.0 * c2_ + s * 3.0 * c3_); }

  /// Where the slope changes from positive to negative in [0, 1], given that it is positive at 0
  /// and negative at 1.
  double peak() const {
    const double root = std::sqrt(std::max(c2_ * c2_ - 3.0 * c1_ * c3_, 0.0));
    return std::clamp(c1_ / (root - c2_), 0.0, 1.0);
  }

  /// Where the value rises through zero between `a` (not above) and `b` (above).
  double rise(double a, double b) const {
    return bisect([this](double s) { return (*this)(s); }, a, b);
  }

 private:
  // Root of a function that is <= 0 at a and > 0 at b: false position kept in its bracket.
  template <class F>
  static double bisect(F f, double a, double b) {
    double fa = f(a);
    double fb = f(b);
    for (int i = 0; i < 60 && b - a > 1e-14; ++i) {
      const double middle = 0.5 * (a + b);
      double s = fb - fa > 0.0 ? a - fa * (b - a) / (fb - fa) : middle;
      if (i % 3 == 2 || !(s > a && s < b)) s = middle;
      const double fs = f(s);
      if (fs == 0.0) return s;
      (fs < 0.0 ? a : b) = s;
      (fs < 0.0 ? fa : fb) = fs;
    }
    return 0.5 * (a + b);
  }

  double c0_, c1_, c2_, c3_;
};

}  // namespace subimpact
