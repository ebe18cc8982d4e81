#include "model/contact/curves.h"

#include <numbers>
#include <stdexcept>

namespace subimpact {
namespace {

using Nose = MeanPressure::Nose;

constexpr double pi = std::numbers::pi;

double sixteenth(double x) {  // power
  for (int i = 0; i < 4; ++i) x *= x;
  return x;
}

double root_16(double x) { return std::sqrt(std::sqrt(std::sqrt(std::sqrt(x)))); }

// p_0/E* times R/a.
double hertz_pressure(Nose nose) { return nose == Nose::ball ? 2.0 / pi : 0.5; }

double first_yield(Nose nose, double p_y, double modulus, double radius) {
  for (const double x : {p_y, modulus, radius}) {
    if (!(x > 0.0) || !std::isfinite(x)) {
      throw std::invalid_argument("contact law: radius, modulus and pressure must be positive");
    }
  }
  return radius * p_y / (hertz_pressure(nose) * modulus);
}

}  // namespace

MeanPressure cut_off_pressure(Nose nose, double p_y, double modulus, double radius) {
  const double a_y = first_yield(nose, p_y, modulus, radius);
  if (nose == Nose::ball) {
    return {a_y, [=](double a) -> ValueAndSlope {
              const double square = std::pow(a_y / a, 2);
              return {p_y * (1.0 - square / 3.0), p_y * 2.0 / 3.0 * square / a};
            }};
  }
  return {a_y, [=](double a) -> ValueAndSlope {
            const double q = a_y / a, s = std::sqrt((1.0 - q) * (1.0 + q)), arc = std::asin(q) / q;
            return {0.5 * p_y * (s + arc), 0.5 * p_y * (arc - s) / a};
          }};
}

MeanPressure pressure_by_depth(Nose nose, double Y, double modulus, double radius) {
  constexpr double fully_plastic = 2.8;
  const bool is_ball = nose == Nose::ball;
  const double share = is_ball ? yield_pressure_over_stress : yield_pressure_over_stress_of_line;
  const double x = share / hertz_pressure(nose);
  const double core = is_ball ? 0.5 + 2.0 / 3.0 * (1.0 + std::log(x / 3.0))
                              : (1.0 + std::log(4.0 * x / (3.0 * pi))) / std::numbers::sqrt3;
  const double core_slope = is_ball ? 2.0 / 3.0 : 1.0 / std::numbers::sqrt3;  // d/d ln a
  // What p/Y and its slope must be at a_y, so that those of p_m are Hertz's.
  const double mean = share * (is_ball ? 2.0 / 3.0 : 0.25 * pi);
  const double left = 1.0 - sixteenth(mean / fully_plastic);
  const double value_there = mean / root_16(left), slope_there = value_there / left;
  const double lacking = value_there - core;                                     // A + B
  const double B = (core_slope - slope_there) / 1.5 - lacking, A = lacking - B;  // 1.5 A + 3 B
  const double a_y = first_yield(nose, share * Y, modulus, radius);
  return {a_y, [=](double a) -> ValueAndSlope {
            const double q = a_y / a, part = q * std::sqrt(q);
            const double value = core - core_slope * std::log(q) + part * (A + B * part);
            const double slope = core_slope - part * (1.5 * A + 3.0 * B * part);
            const double rest = 1.0 + sixteenth(value / fully_plastic), scale = Y / root_16(rest);
            return {scale * value, scale * slope / (rest * a)};
          }};
}

MonotoneCurve::MonotoneCurve(std::span<const double> x, std::span<const double> y) {
  const std::size_t n = x.size();
  if (n < 2 || y.size() != n) throw std::invalid_argument("a curve has at least two points");
  std::vector<double> chords(n - 1), slopes(n);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (!(x[i + 1] > x[i]) || !(y[i + 1] > y[i])) throw std::invalid_argument("a curve rises");
    chords[i] = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
  }
  slopes.front() = chords.front();
  slopes.back() = chords.back();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double left = x[i] - x[i - 1], right = x[i + 1] - x[i];
    const double a = 2.0 * right + left, b = right + 2.0 * left;
    slopes[i] = (a + b) / (a / chords[i - 1] + b / chords[i]);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double h = x[i + 1] - x[i];
    pieces_.push_back({x[i], h, y[i], slopes[i],
                       (3.0 * chords[i] - 2.0 * slopes[i] - slopes[i + 1]) / h,
                       (slopes[i] + slopes[i + 1] - 2.0 * chords[i]) / (h * h), sum});
    sum += pieces_.back().integral_to(h);
  }
  pieces_.push_back({x[n - 1], HUGE_VAL, y[n - 1], slopes[n - 1], 0.0, 0.0, sum});
}

const MonotoneCurve::Piece& MonotoneCurve::piece_at(double x) const {
  const auto after = std::ranges::upper_bound(pieces_, x, {}, &Piece::start);
  return after == pieces_.begin() ? *after : *std::prev(after);
}

double MonotoneCurve::value(double x) const {
  const Piece& piece = piece_at(x);
  const double t = x - piece.start;
  return t < 0.0 ? piece.value + t * piece.slope : piece.at(t);
}

double MonotoneCurve::slope(double x) const {
  const Piece& piece = piece_at(x);
  return piece.slope_at(std::max(x - piece.start, 0.0));
}

double MonotoneCurve::integral(double x) const {
  const Piece& piece = piece_at(x);
  const double t = x - piece.start;
  return t < 0.0 ? t * (piece.value + 0.5 * t * piece.slope) : piece.before + piece.integral_to(t);
}

double MonotoneCurve::largest_slope() const {
  double largest = 0.0;
  for (const Piece& piece : pieces_) {
    largest = std::max(largest, piece.slope);
    const double t = piece.cube < 0.0 ? -piece.square / (3.0 * piece.cube) : 0.0;
    if (t > 0.0 && t < piece.length) largest = std::max(largest, piece.slope_at(t));
  }
  return largest;
}

}  // namespace subimpact
