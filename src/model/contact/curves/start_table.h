#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace subimpact {

/// Newton's method in ln x for curve(x) = target, x > 0, of a curve that rises nearly as a power of
/// exponent 1 to 2; `curve` gives value and slope.
template <class Curve>
double inverse_of_power(const Curve& curve, double target, double start) {
  constexpr int most_steps = 60;
  constexpr double small = 0.05, done = 1e-7;  // a fiftieth of its square is a rounding
  double x = start;
  for (int i = 0; i < most_steps; ++i) {
    const auto [value, slope] = curve(x);
    const double exponent = x * slope / value, rest = target / value - 1.0;
    if (!(std::abs(rest) < small)) {
      x *= std::exp(std::log1p(rest) / exponent);
      continue;
    }
    x *= 1.0 + rest / exponent * (1.0 + 0.5 * rest * (1.0 / exponent - 1.0));
    if (std::abs(rest) < done) break;
  }
  return x;
}

/// Starting values for inverse_of_power, right to some 1e-8, so that one step suffices: ln x over
/// the logarithm of the value, by cubics between points that are a sixteenth apart.
class StartTable {
 public:
  StartTable() = default;
  /// For arguments from `from` to `to`, between which the curve has no kink.
  template <class Curve>
  StartTable(const Curve& curve, double from, double to) {
    constexpr double spacing = 0.0625;
    const auto [least, slope_there] = curve(from);
    first_ = std::log(least);
    const double range = std::log(curve(to).at) - first_;
    const int n = std::max(1, static_cast<int>(std::ceil(range / spacing)));
    step_ = range / n;
    double x = from, exponent = from * slope_there / least;
    for (int i = 0; i <= n; ++i) {
      const double value = std::exp(first_ + i * step_);
      x = inverse_of_power(curve, value, i == 0 ? x : x * std::exp(step_ / exponent));
      const auto [at, slope] = curve(x);
      exponent = x * slope / at;
      points_.push_back({std::log(x), step_ / exponent});
    }
  }

  /// Or `otherwise`, outside the table.
  double operator()(double value, double otherwise) const {
    const double place = (std::log(value) - first_) / step_;
    if (!(place >= 0.0 && place < static_cast<double>(points_.size()) - 1.0)) return otherwise;
    const auto i = static_cast<std::size_t>(place);
    const double s = place - static_cast<double>(i);
    const auto& [y0, d0] = points_[i];
    const auto& [y1, d1] = points_[i + 1];
    const double rise = y1 - y0;
    return std::exp(y0 +
                    s * (d0 + s * ((3.0 * rise - 2.0 * d0 - d1) + s * (d0 + d1 - 2.0 * rise))));
  }

 private:
  struct Point {
    double x, slope;  // ln x, and its slope times the step
  };
  double first_ = 0.0, step_ = 1.0;  // logarithms of values
  std::vector<Point> points_;
};

}  // namespace subimpact
