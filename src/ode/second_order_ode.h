#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "subimpact/ode/second_order_ode.h"

namespace subimpact {

/// Which entries of a square sparse matrix exist, column by column: column j has the rows
/// rows[column_starts[j]] to rows[column_starts[j + 1] - 1], ascending.
struct SparsityPattern {
  std::vector<std::size_t> column_starts{0};
  std::vector<std::size_t> rows;

  std::size_t size() const { return column_starts.size() - 1; }
  std::size_t n_entries() const { return rows.size(); }
};

/// Mass q'' = f(q, v): what implicit integrators need besides the acceleration. Mass, the tangent
/// stiffness K = -df/dq and the damping matrix C = -df/dv share one pattern, which never changes;
/// their entries are arrays in the order of that pattern. Unless the system
/// depends_on_velocity(), of y = [q, v] only q is read.
class MechanicalSystem : public SecondOrderOde {
 public:
  /// f at y; changes no history.
  virtual void force(std::span<const double> y, std::span<double> result) = 0;
  virtual const SparsityPattern& pattern() const = 0;
  virtual void mass_entries(std::span<double> values) const = 0;
  /// K at y.
  virtual void stiffness_entries(std::span<const double> y, std::span<double> values) = 0;
  /// C at y; called only of a system that depends_on_velocity().
  virtual void damping_entries(std::span<const double> /*y*/, std::span<double> values) {
    std::fill(values.begin(), values.end(), 0.0);
  }
};

/// Independent oscillators that share one scalar force, which depends on one scalar displacement:
///
///     q_i'' + 2 delta_i q_i' + omega_i^2 q_i = b_i F(lambda) + p_i(t),   lambda = sum c_i q_i.
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
  /// Further accelerations that are linear in time between restarts, a + b (t - t0) on each
  /// oscillator: a (m/s2 per unit of q) and b at a time t0; empty: there are none.
  struct Loads {
    std::span<const double> value, rate;
  };
  virtual bool has_loads() const { return false; }
  virtual Loads loads_from(double /*t0*/) { return {}; }
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
