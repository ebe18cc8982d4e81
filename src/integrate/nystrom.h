#pragma once

#include <optional>
#include <string>
#include <vector>

#include "integrate/options.h"
#include "numerics/lanes.h"
#include "ode/integrator.h"

namespace subimpact {

/// An embedded Runge-Kutta-Nystroem table for q'' = a(q): stages
///
///     q_i = q + c_i h v + h^2 sum_j a_ij k_j,   k_i = a(q_i),
///     q' = q + h v + h^2 sum position_i k_i,    v' = v + h sum velocity_i k_i,
///
/// and differences to the embedded method (order `embedded_order`) for the error estimate.
struct NystromTable : CoefficientTable {
  std::vector<double> c;
  std::vector<std::vector<double>> a;  ///< a[i] has i entries
  std::vector<double> position, velocity;
  std::vector<double> position_error, velocity_error;

  std::size_t n_stages() const { return c.size(); }
  /// Whether the last stage is the acceleration at the step's end, and so the next step's first.
  bool first_same_as_last() const;
};

/// All tables; the first is the default.
const std::vector<NystromTable>& nystrom_tables();

/// The first for an empty name. Throws std::invalid_argument for an unknown one.
const NystromTable& nystrom_table(const std::string& name);

/// Explicit Runge-Kutta-Nystroem methods for q'' = a(q): stages carry positions only, which halves
/// the vector work and, order for order, the evaluations of a Runge-Kutta method.
///
/// Error control as in `erk`: weighted root-mean-square norm of the estimate with the constant
/// weights 1/(rtol * scale), a proportional-integral controller, rejected steps retaken. A state
/// inside the last step is a retaken, shorter step. Throws std::invalid_argument for other tables.
class Nystrom final : public Integrator {
 public:
  Nystrom(SecondOrderOde& ode, const IntegratorOptions& options);

  void restart(double t, const State& y) override;
  void step() override;
  void state_at(double t, State& y) override;

 private:
  using Vector = AlignedVector;
  // The stages of a step of length h from (y0_, stages_[0]), and its end.
  void advance(double h, std::vector<Vector>& stages, State& y);
  double error_norm(double h) const;
  void accelerate(double t, const double* positions, Vector& result);

  SecondOrderOde& ode_;
  const NystromTable& table_;
  bool first_same_as_last_;
  std::size_t n_;
  std::optional<double> fixed_step_;
  double max_step_;
  double position_weight_, velocity_weight_;
  double next_step_ = 0.0;
  double previous_error_ = 1.0;
  std::vector<Vector> stages_;          // accelerations of the last step's stages
  std::vector<Vector> partial_stages_;  // of a partial step; the first is not used
  Vector end_acceleration_;             // at time(), the next step's first stage
};

}  // namespace subimpact
