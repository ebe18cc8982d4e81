#pragma once

/// Central differences of one number of a run over two shifts of a key.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "subimpact/study/sensitivity/sensitivity.h"

namespace subimpact {

/// One number of a base run and of the four shifted runs of a key.
struct Stencil {
  static constexpr double shift_ratio = sensitivity_shifts[0] / sensitivity_shifts[1];

  double base = 0.0;
  std::array<double, sensitivity_shifts.size()> plus{}, minus{};

  double slope(std::size_t i) const { return (plus[i] - minus[i]) / (2.0 * sensitivity_shifts[i]); }
  /// Whether the number never changes, as for the first touch, where time begins.
  bool is_constant() const {
    const auto is_base = [this](double f) { return f == base; };
    return std::ranges::all_of(plus, is_base) && std::ranges::all_of(minus, is_base);
  }
  /// The mean of the values at both shifts minus the value between them.
  double bend(std::size_t i) const { return 0.5 * (plus[i] - base + (minus[i] - base)); }
};

/// The error of one run, from second differences: the bend at the smaller shift, minus its value
/// extrapolated from the larger shift for a smooth number, is that error times the root of 3/2.
inline double noise_of(const Stencil& s) {
  return std::abs(s.bend(1) - s.bend(0) / (s.shift_ratio * s.shift_ratio)) / std::sqrt(1.5);
}

/// The difference of the two slopes in excess of the errors of runs (`error`: of one run).
inline double bend_of_slope(const Stencil& s, double error) {
  return std::max(0.0, std::abs(s.slope(0) - s.slope(1)) - error / sensitivity_shifts[1]);
}

/// Where sections yield, a section may just not flow for one value of a key and flow for another,
/// for a time that grows as the root of the distance; the error of slopes then has a root, too.
enum class Smoothness { everywhere, between_thresholds };

/// The derivative and its error, as sensitivity() describes. `error`: of one run.
inline Derivative derivative_of(const Stencil& s, double error, Smoothness smoothness) {
  // Stated error over the error that follows from a difference.
  constexpr double safety = 3.0;
  // Share of the difference of slopes that extrapolation adds to the slope of the smaller shift.
  constexpr double gain_if_smooth = 1.0 / (Stencil::shift_ratio * Stencil::shift_ratio - 1.0);
  // Share that may remain of an error that grows as the root of the shift.
  constexpr double left_by_thresholds = 0.46;  // 1/(sqrt(shift_ratio) - 1)
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

/// Whether the slopes to either side differ: by as much over the smaller shift as over the larger
/// one. For smooth numbers it is less by the ratio of the shifts, for the errors of runs more.
/// `error`: of the base run.
inline bool has_kink(const Stencil& s, double error) {
  constexpr double kink_share = 1e-3;  // of the slope
  const double larger = std::abs(s.bend(0)) / sensitivity_shifts[0];
  const double smaller = std::abs(s.bend(1)) / sensitivity_shifts[1];
  return smaller > 0.5 * larger && smaller < 2.0 * larger &&
         smaller > kink_share * std::abs(s.slope(1)) && std::abs(s.bend(1)) > 3.0 * error;
}

}  // namespace subimpact
