#pragma once

#include <cstddef>
#include <span>

#include "ode/second_order_ode.h"

namespace subimpact {

/// Independent oscillators that share one scalar force, which depends on one scalar displacement:
///
///     q_i'' + 2 delta_i q_i' + omega_i^2 q_i = b_i F(lambda),   lambda = sum c_i q_i.
///
/// omega_i = 0 is a body moving freely, or slowed down by delta_i. Between events F is smooth; it
/// may be zero throughout.
class ForcedOscillators {
 public:
  virtual ~ForcedOscillators() = default;

  virtual std::span<const double> frequencies() const = 0;  ///< omega, rad/s
  /// delta, 1/s; empty: no damping.
  virtual std::span<const double> decay_rates() const { return {}; }
  virtual std::span<const double> loads() const = 0;          ///< b, 1/kg per unit of q
  virtual std::span<const double> displacements() const = 0;  ///< c
  std::size_t size() const { return frequencies().size(); }

  struct Force {
    double value;  ///< F, N
    double slope;  ///< dF/dlambda, N/m
  };
  /// The force of the mode in force, continued beyond its range.
  virtual Force force(double lambda) const = 0;
  /// Whether F is zero throughout: free motion.
  virtual bool is_free() const = 0;
  /// The displacement at which the mode in force begins or ends. Steps near it
  /// are short enough that a cubic through their ends shows on which side lambda is.
  virtual double critical_displacement() const = 0;

  virtual SecondOrderOde::Scales scales() const = 0;
};

}  // namespace subimpact
