#pragma once

/// Central differences of one number of a run over two shifts of a key.

#include <algorithm>
#include <array>

#include "subimpact/study/sensitivity.h"

namespace subimpact {

/// One number of a base run and of the four shifted runs of a key.
struct Stencil {
  double base = 0.0;
  std::array<double, sensitivity_shifts.size()> plus{}, minus{};

  double slope(std::size_t i) const { return (plus[i] - minus[i]) / (2.0 * sensitivity_shifts[i]); }
  /// As the first touch, which is where time begins.
  bool is_constant() const {
    const auto is_base = [this](double f) { return f == base; };
    return std::ranges::all_of(plus, is_base) && std::ranges::all_of(minus, is_base);
  }
  /// Of the values at both shifts, the mean less the value between them.
  double bend(std::size_t i) const { return 0.5 * (plus[i] - base + (minus[i] - base)); }
};

/// What the errors of single runs come to in the second differences.
double noise_of(const Stencil& s);

/// The difference of the two slopes beyond what the errors of runs (`error`: of one) account for.
double bend_of_slope(const Stencil& s, double error);

/// Where sections yield, a section that just does not flow for one value of a key does so for
/// another, for a time that grows as the root of the distance: slopes then have a root's error.
enum class Smoothness { everywhere, between_thresholds };

/// The derivative and its error, as sensitivity() describes. `error`: of one run.
Derivative derivative_of(const Stencil& s, double error, Smoothness smoothness);

/// Whether the slopes to either side differ: by as much over the smaller shift as over the larger
/// one. For smooth numbers it is less by the ratio of the shifts, for the errors of runs more.
/// `error`: of the base run.
bool has_kink(const Stencil& s, double error);

}  // namespace subimpact
