#pragma once

#include <map>
#include <memory>

#include "integrate/options.h"
#include "integrate/oscillator_step.h"
#include "ode/integrator.h"

namespace subimpact {

/// The exponential method: oscillators driven by one scalar force, a cubic over each step that is
/// collocated at its four Gauss points (docs/theory.md, "The exponential method").
///
/// The error estimate, the defect at the step's two ends times the response of lambda to a constant
/// unit force over the step, is held below rtol times the displacement scale. Step lengths are
/// unit/2^level.
///
/// An event search uses the step's ends and a cubic in lambda through them. So a step is also
/// halved until that cubic resolves the side of the critical displacement on which lambda lies, or
/// shows a single crossing with a rate above the error of the cubic's rate. In contact the cubic's
/// uncertainty comes from its distance to lambda at the Gauss points; in free motion it has a
/// bound, |lambda''''| <= sum |c_i| A_i omega_i^4 with the constant amplitudes A_i, so that the
/// cubic is off by at most h^4/384 times that. With damping A_i omega_i falls, and (q', omega q)
/// changes at most at the rate delta + sqrt(omega^2 + delta^2) of its size, which stands for the
/// other three factors; far beyond critical damping the two exponentials are bounded one by one.
/// The bound then falls from step to step.
///
/// state_at gives the flow under the step's force: exact but for the cubic. So the order is eight
/// at the ends of steps and six within them, and for event times: a cubic misses the force by
/// O(h^4), and lambda is its second integral.
class Exponential final : public Integrator {
 public:
  Exponential(std::unique_ptr<ForcedOscillators> oscillators, const IntegratorOptions& options);

  void restart(double t, const State& y) override;
  void step() override;
  void state_at(double t, State& y) override;
  bool integrate_squared_velocities(double t, std::span<double> result) override;

 private:
  struct Ends {
    double lambda0, rate0, lambda1, rate1;
  };
  const OscillatorStep& table(int level);
  double displacement(const double* values) const;  // sum c_i values_i
  void free_step();
  void forced_step();
  // Solves the collocation equations; false if Newton's method does not converge.
  bool solve(const OscillatorStep& step, const NodeForces& free, NodeForces& forces,
             NodeForces& lambda) const;
  double fourth_derivative_bound() const;
  // Whether a cubic off by up to `uncertainty` (m) shows the side of the critical displacement.
  bool resolves_side(const Ends& ends, double h, double uncertainty) const;

  std::unique_ptr<ForcedOscillators> owned_;
  ForcedOscillators& oscillators_;
  IntegratorOptions options_;
  std::size_t n_;
  SecondOrderOde::Scales scales_;
  double unit_;  // length of level 0, s
  std::map<int, std::unique_ptr<OscillatorStep>> tables_;
  int level_ = 0;  // of the next step; step length unit / 2^level
  int first_level_ = 0;
  double bound_ = -1.0;  // of |lambda''''| in the present free motion; negative: not computed
  ForcePolynomial force_;
  double force_length_ = 0.0;
  double lambda1_ = 0.0, rate1_ = 0.0;  // at time()
  double size_ = 0.0;                   // sum |c_i q_i| at the step's start
};

}  // namespace subimpact
