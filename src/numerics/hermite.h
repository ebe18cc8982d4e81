#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "numerics/bracketed_root.h"

namespace subimpact {

/// Cubic through a value and a rate at both ends of a step, as a function of s in [0, 1]. It only
/// ever supplies first guesses: reported values are located on the trajectory itself.
class HermiteCubic {
 public:
  HermiteCubic(double value0, double rate0, double value1, double rate1, double step)
      : c0_(value0),
        c1_(step * rate0),
        c2_(3.0 * (value1 - value0) - step * (2.0 * rate0 + rate1)),
        c3_(2.0 * (value0 - value1) + step * (rate0 + rate1)) {}

  double operator()(double s) const { return c0_ + s * (c1_ + s * (c2_ + s * c3_)); }
  double slope(double s) const { return c1_ + s * (2.0 * c2_ + s * 3.0 * c3_); }

  double least_slope() const {
    const double s = -c2_ / (3.0 * c3_);
    const double ends = std::min(slope(0.0), slope(1.0));
    return s > 0.0 && s < 1.0 ? std::min(ends, slope(s)) : ends;
  }

  /// Where the slope changes its sign in [0, 1], given that it is positive at 0 and negative at 1.
  double peak() const {
    const double root = std::sqrt(std::max(c2_ * c2_ - 3.0 * c1_ * c3_, 0.0));
    return std::clamp(c1_ / (root - c2_), 0.0, 1.0);
  }

  /// Where the value has a local maximum inside (0, 1), if anywhere.
  std::optional<double> maximum() const {
    const double discriminant = c2_ * c2_ - 3.0 * c1_ * c3_;
    if (!(discriminant > 0.0)) return std::nullopt;
    const double s = c1_ / (std::sqrt(discriminant) - c2_);
    if (s > 0.0 && s < 1.0) return s;
    return std::nullopt;
  }

  /// Where, between equal senses at both ends, the slope is farthest in the other sense, if ever.
  std::optional<double> reversed_at() const {
    const double last = c1_ + 2.0 * c2_ + 3.0 * c3_;
    const double s = -c2_ / (3.0 * c3_);
    if (c1_ * last > 0.0 && s > 0.0 && s < 1.0 && c1_ * slope(s) < 0.0) return s;
    return std::nullopt;
  }
  /// Where the two extrema are if there is a reversed_at(), in order.
  std::pair<double, double> extrema() const {
    const double root = std::sqrt(std::max(c2_ * c2_ - 3.0 * c1_ * c3_, 0.0));
    const double a = std::clamp((-c2_ - root) / (3.0 * c3_), 0.0, 1.0);
    const double b = std::clamp((-c2_ + root) / (3.0 * c3_), 0.0, 1.0);
    return {std::min(a, b), std::max(a, b)};
  }

  /// Where the value rises through zero between `a` (not above) and `b` (above).
  double rise(double a, double b) const {
    // From zero the value may fall first; rounding may have taken the sign at an end.
    if ((*this)(a) == 0.0 && slope(a) < 0.0) a += epsilon * (b - a);
    if (!((*this)(a) < 0.0)) return a;
    if (!((*this)(b) > 0.0)) return b;
    return root_in(*this, a, b);
  }

 private:
  static constexpr double epsilon = std::numeric_limits<double>::epsilon();
  double c0_, c1_, c2_, c3_;
};

/// Septic through a value and its first three rates at both ends of a step; s in [0, 1].
class HermiteSeptic {
 public:
  struct End {
    double value, rate, second, third;
  };
  HermiteSeptic(const End& start, const End& end, double step) {
    const double h2 = step * step;
    const double h3 = h2 * step;
    c_[0] = start.value;
    c_[1] = step * start.rate;
    c_[2] = h2 * start.second / 2.0;
    c_[3] = h3 * start.third / 6.0;
    // By how much the start's cubic misses the end.
    const double d0 = end.value - (c_[0] + c_[1] + c_[2] + c_[3]);
    const double d1 = step * end.rate - (c_[1] + 2.0 * c_[2] + 3.0 * c_[3]);
    const double d2 = h2 * end.second - (2.0 * c_[2] + 6.0 * c_[3]);
    const double d3 = h3 * end.third - 6.0 * c_[3];
    c_[4] = 35.0 * d0 - 15.0 * d1 + 2.5 * d2 - d3 / 6.0;
    c_[5] = -84.0 * d0 + 39.0 * d1 - 7.0 * d2 + 0.5 * d3;
    c_[6] = 70.0 * d0 - 34.0 * d1 + 6.5 * d2 - 0.5 * d3;
    c_[7] = -20.0 * d0 + 10.0 * d1 - 2.0 * d2 + d3 / 6.0;
  }

  double operator()(double s) const {
    double sum = c_[7];
    for (int i = 6; i >= 0; --i) sum = sum * s + c_[i];
    return sum;
  }
  double slope(double s) const {
    double sum = 7.0 * c_[7];
    for (int i = 6; i >= 1; --i) sum = sum * s + i * c_[i];
    return sum;
  }
  double second(double s) const {
    double sum = 42.0 * c_[7];
    for (int i = 6; i >= 2; --i) sum = sum * s + i * (i - 1) * c_[i];
    return sum;
  }
  /// Where the slope vanishes, given a guess, if it has opposite signs at 0 and at 1.
  double extremum(double guess) const {
    const double sign = slope(1.0) > 0.0 ? 1.0 : -1.0;
    return find_rise(
        [&](double s) {
          return EventValue{sign * slope(s), sign * second(s)};
        },
        0.0, 1.0, guess, 1e-15);
  }

 private:
  double c_[8];
};

}  // namespace subimpact
