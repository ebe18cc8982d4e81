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
/// unit/2^level. state_at gives the flow under the step's force: of order eight at the ends of
/// steps, and of order six within them and for event times.
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
  void read_end();                             // lambda and its rate at y1_
  void end_step(const OscillatorStep& taken);  // y1_ without loads is its end
  void free_step();
  void forced_step();
  // Solves the collocation equations; false if Newton's method does not converge.
  bool solve(const OscillatorStep& step, const NodeForces& free, NodeForces& forces,
             NodeForces& lambda) const;
  // Largest error (m) of the cubic through the ends of a free step from y0 of the length h.
  double error_of_cubic(double h) const;
  // What fast modes add to the error of the cubic through the ends of a forced step under force_.
  double error_of_swings(const OscillatorStep& step) const;
  // Whether a cubic off by up to `uncertainty` (m) shows the side of the critical displacement.
  bool resolves_side(const Ends& ends, double h, double uncertainty) const;

  std::unique_ptr<ForcedOscillators> owned_;
  ForcedOscillators& oscillators_;
  IntegratorOptions options_;
  std::size_t n_;
  SecondOrderOde::Scales scales_;
  double unit_;                                // length of level 0, s
  std::vector<double> per_square_, response_;  // 1/omega^2 and b/omega^2; of rigid modes 0
  std::vector<double> twice_decay_;            // 2 delta
  std::map<int, std::unique_ptr<OscillatorStep>> tables_;
  int level_ = 0;  // of the next step; step length unit / 2^level
  int first_level_ = 0;
  // error_of_cubic(1) in the present free motion without damping; negative: not computed
  double bound_ = -1.0;
  ForcePolynomial force_;
  double force_length_ = 0.0;
  ForcedOscillators::Loads step_loads_;  // from the step's start on
  double lambda1_ = 0.0, rate1_ = 0.0;   // at time()
  double size_ = 0.0;                    // sum |c_i q_i| at the step's start
};

}  // namespace subimpact
