#pragma once

#include <cstddef>
#include <span>

#include "ode/second_order_ode.h"

namespace subimpact {

/// Stretches of motion in which a system is nothing but independent oscillators about an
/// equilibrium, seen as such by an integrator that knows of nothing else:
///
///     z_k'' + omega_k^2 z_k = 0,   as long as   low_i < sum_k g_ik z_k < high_i   for all i.
///
/// omega_k = 0 is a body moving uniformly. The equilibrium and the limits change from stretch to
/// stretch, the frequencies and the guards g do not. In the first n - 1 guards oscillators of
/// frequency 0 have no part.
class FreeFlight {
 public:
  virtual ~FreeFlight() = default;

  virtual std::span<const double> frequencies() const = 0;  ///< omega, rad/s, n of them, ascending
  virtual std::size_t n_guards() const = 0;
  /// g_i, n coefficients.
  virtual std::span<const double> guard(std::size_t i) const = 0;

  /// Whether such a stretch begins at the last committed state.
  virtual bool possible() const = 0;
  /// For a state y at which one begins: how long the guards would keep within their limits if all
  /// rates stayed as they are, s. A first look, not a bound.
  virtual double outlook(const State& y) = 0;
  /// Displacements z and their rates for a state y at which one begins, and its limits.
  virtual void enter(const State& y, std::span<double> z, std::span<double> rates,
                     std::span<double> low, std::span<double> high) = 0;
  /// The state for displacements and rates of the stretch entered last.
  virtual void leave(std::span<const double> z, std::span<const double> rates, State& y) const = 0;
};

}  // namespace subimpact
