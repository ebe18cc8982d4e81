#include "model/contact/curves/mean_pressure.h"

#include <cmath>
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

}  // namespace subimpact
