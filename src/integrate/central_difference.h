#pragma once

#include "numerics/lanes.h"
#include "ode/integrator.h"

namespace subimpact {

/// Explicit central differences, the struck-beam paper's scheme, second order, fixed step:
///
///     (q[n+1] - 2 q[n] + q[n-1])/dt^2 = a(q[n]),
///
/// written with the velocity, so that the scheme is self-starting and can take a partial step (the
/// same positions to rounding): v[n+1/2] = v[n] + dt/2 a[n], q[n+1] = q[n] + dt v[n+1/2], v[n+1] =
/// v[n+1/2] + dt/2 a[n+1]. One acceleration per step. Stable for dt * omega_max < 2. The last
/// position may be advanced by a force that is constant over the step instead (docs/theory.md,
/// "Central differences").
class CentralDifference final : public Integrator {
 public:
  /// `step` in s; the caller must keep it below the critical step.
  CentralDifference(SecondOrderOde& ode, double step, bool constant_force_on_last = false);

  void restart(double t, const State& y) override;
  void step() override;
  void state_at(double t, State& y) override;
  /// The scheme is reversible in time: a step from the end with the velocity reversed.
  void state_before_end(double t, State& y) override;
  bool ends_at_last_evaluation() const override { return true; }

 private:
  // One step of length h, perhaps below 0, from (from, a_from) into y; leaves a(q) there.
  void advance(double t, double h, const State& from, const AlignedVector& a_from, State& y,
               AlignedVector& acceleration);

  SecondOrderOde& ode_;
  std::size_t n_;
  double step_;
  bool constant_force_on_last_;
  double origin_ = 0.0;  // times are origin + k step, free of accumulated rounding
  long steps_from_origin_ = 0;
  AlignedVector a0_, a1_, a_partial_;
};

}  // namespace subimpact
