#include "study/stencil.h"

#include <cmath>
#include <limits>

namespace subimpact {
namespace {

// Stated error over the one that a difference stands for.
constexpr double safety = 3.0;
constexpr double kink_share = 1e-3;  // of the slope
constexpr double shift_ratio = sensitivity_shifts[0] / sensitivity_shifts[1];
// What extrapolation adds to the slope over the smaller shift, of its difference from the other.
constexpr double gain_if_smooth = 1.0 / (shift_ratio * shift_ratio - 1.0);
// What may be left of an error that grows as the root of the shift, in the same unit.
constexpr double left_by_thresholds = 0.46;  // 1/(sqrt(shift_ratio) - 1)

}  // namespace

// The bend at the smaller shift, less what follows for it from the larger one if the number is
// smooth: the error of one run, times the root of 3/2.
double noise_of(const Stencil& s) {
  return std::abs(s.bend(1) - s.bend(0) / (shift_ratio * shift_ratio)) / std::sqrt(1.5);
}

double bend_of_slope(const Stencil& s, double error) {
  return std::max(0.0, std::abs(s.slope(0) - s.slope(1)) - error / sensitivity_shifts[1]);
}

Derivative derivative_of(const Stencil& s, double error, Smoothness smoothness) {
  if (s.is_constant()) return {};
  const double step = s.slope(1) - s.slope(0);
  const double noise = error + std::numeric_limits<double>::epsilon() * std::abs(s.base);
  const double gain = smoothness == Smoothness::everywhere ? gain_if_smooth : 0.0;
  const double left = smoothness == Smoothness::everywhere ? gain_if_smooth : left_by_thresholds;
  const double of_larger = std::abs(step) * (1.0 + left) + noise / sensitivity_shifts[0];
  const double of_smaller = std::abs(step) * left + noise / sensitivity_shifts[1];
  if (of_larger < of_smaller) return {s.slope(0), safety * of_larger};
  return {s.slope(1) + gain * step, safety * of_smaller};
}

bool has_kink(const Stencil& s, double error) {
  const double larger = std::abs(s.bend(0)) / sensitivity_shifts[0];
  const double smaller = std::abs(s.bend(1)) / sensitivity_shifts[1];
  return smaller > 0.5 * larger && smaller < 2.0 * larger &&
         smaller > kink_share * std::abs(s.slope(1)) && std::abs(s.bend(1)) > 3.0 * error;
}

}  // namespace subimpact
