#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace subimpact {

/// A value and its derivative.
struct ValueAndSlope {
  double at, slope;
};

/// The mean pressure p_m (Pa) under a round nose that a yielding surface carries, as a function of
/// the half width a (m) of the contact (the radius, under a ball). Up to first yield, a_y, it is
/// Hertz's: 2/3 of the pressure p_0 in the middle under a ball, pi/4 under a cylinder. Beyond, with
/// q = a_y/a, either the pressure is cut off at a constant p_y = p_0(a_y), as Thornton does,
///
///     ball      p_m = p_y (1 - q^2/3)
///     cylinder  p_m = p_y/2 (sqrt(1 - q^2) + asin(q)/q),
///
/// where p_y is a largest pressure, which the mean nears when fully plastic; or the mean rises with
/// the depth of the dent by the model of an expanding core (p_c: docs/theory/contact.md):
///
///     p_m = p (1 + (p/p_f)^16)^(-1/16),  p = p_c + A q^1.5 + B q^3,  p_f = 2.8 Y (fully plastic)
///
/// from p_0 = 1.6 Y (ball) or 1.67 Y (cylinder) on. A and B make p_m and its slope Hertz's at a_y:
/// the core model, which takes the contact for a core under even pressure, does not have them
/// there. The cut-off that belongs to this mean is the p_y of the first formulas.
///
/// Sources: K. L. Johnson, Contact Mechanics, sections 6.1 and 6.3; the 1/2: C. J. Studman, M. A.
/// Moore, S. E. Jones, On the correlation of indentation experiments, J. Phys. D 10 (1977) 949.
struct MeanPressure {
  enum class Nose { ball, cylinder };

  double first_yield;                              ///< a_y
  std::function<ValueAndSlope(double)> beyond_it;  ///< p_m, dp_m/da for a > a_y
};

/// p_y, Y and E* in Pa, R in m; std::invalid_argument unless they are positive and finite.
MeanPressure cut_off_pressure(MeanPressure::Nose nose, double p_y, double modulus, double radius);
MeanPressure pressure_by_depth(MeanPressure::Nose nose, double Y, double modulus, double radius);

/// Largest pressure over yield stress at which metals yield under a ball and under a cylinder.
inline constexpr double yield_pressure_over_stress = 1.6;
inline constexpr double yield_pressure_over_stress_of_line = 1.67;

/// A smooth curve through points that rise: cubic pieces whose slopes at the points keep it from
/// overshooting, so that it rises everywhere, with its exact integral. Beyond its ends it goes on
/// straight.
///
/// Source: F. N. Fritsch and R. E. Carlson, Monotone piecewise cubic interpolation, SIAM J. Numer.
/// Anal. 17 (1980); the slopes are weighted harmonic means of the neighbouring chords.
class MonotoneCurve {
 public:
  MonotoneCurve() = default;
  /// At least two points; `x` and `y` rise. Throws std::invalid_argument otherwise.
  MonotoneCurve(std::span<const double> x, std::span<const double> y);

  double value(double x) const;
  double slope(double x) const;
  double integral(double x) const;  ///< from the first point on
  double largest_slope() const;     ///< between the ends

 private:
  // y = value + t (slope + t (square + t cube)), t = x - start.
  struct Piece {
    double start, length;
    double value, slope, square, cube;
    double before;  // integral up to its start
    double at(double t) const { return value + t * (slope + t * (square + t * cube)); }
    double slope_at(double t) const { return slope + t * (2.0 * square + 3.0 * t * cube); }
    double integral_to(double t) const {
      return t * (value + t * (slope / 2.0 + t * (square / 3.0 + t * cube / 4.0)));
    }
  };
  const Piece& piece_at(double x) const;

  std::vector<Piece> pieces_;  // the last one is straight, and so is the line before the first
};

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
