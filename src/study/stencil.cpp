#include "study/stencil.h"

#include <cmath>
#include <limits>

namespace subimpact {
namespace {

// Stated error over the one that a difference stands for.
constexpr double safety = 2.0;
constexpr double kink_share = 1e-3;  // of the slope
constexpr double shift_ratio = sensitivity_shifts[0] / sensitivity_shifts[1];

// What extrapolation leaves of an error, as its share. Where a graze is at the distance d, numbers
// change as the root of d: their slope is off by the part r = (h/d)^2/8, after it by 3.5 r^2.
double share_left(double step, double slope) {
  constexpr double of_root = 3.5, least = 0.1;
  return std::min(1.0, least + of_root * std::abs(step / slope));
}

}  // namespace

// The bend at the smaller shift, less what follows for it from the larger one if the number is
// smooth: the error of one run, times the root of 3/2.
double noise_of(const Stencil& s) {
  return std::abs(s.bend(1) - s.bend(0) / (shift_ratio * shift_ratio)) / std::sqrt(1.5);
}

double bend_of_slope(const Stencil& s, double error) {
  return std::max(0.0, std::abs(s.slope(0) - s.slope(1)) - error / sensitivity_shifts[1]);
}

Derivative derivative_of(const Stencil& s, double error) {
  if (s.is_constant()) return {};
  constexpr double gain = 1.0 / (shift_ratio * shift_ratio - 1.0);
  const double step = s.slope(1) - s.slope(0);
  const double extrapolated = s.slope(1) + gain * step;
  const double noise = error + std::numeric_limits<double>::epsilon() * std::abs(s.base);
  const double of_larger = std::abs(step) + noise / sensitivity_shifts[0];
  const double of_extrapolated =
      gain * std::abs(step) * share_left(step, extrapolated) + noise / sensitivity_shifts[1];
  if (of_larger < of_extrapolated) return {s.slope(0), safety * of_larger};
  return {extrapolated, safety * of_extrapolated};
}

bool has_kink(const Stencil& s, double error) {
  const double larger = std::abs(s.bend(0)) / sensitivity_shifts[0];
  const double smaller = std::abs(s.bend(1)) / sensitivity_shifts[1];
  return smaller > 0.5 * larger && smaller < 2.0 * larger &&
         smaller > kink_share * std::abs(s.slope(1)) && std::abs(s.bend(1)) > 3.0 * error;
}

}  // namespace subimpact
