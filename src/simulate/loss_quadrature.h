#pragma once

#include <span>
#include <vector>

#include "simulate/observed_step.h"

namespace subimpact {

/// Energy that velocity-dependent forces dissipate, integrated over time along the trajectory:
///
///     contact closed      chi F_0 lambda'^2
///     contact recovering  -F_0 lambda', the law's elastic energy, which recovers without a force
///     beam                v^T C v
///
/// independently of the energies, whose balance it closes.
///
/// Over a step positions are taken as the quintics through positions, velocities and accelerations
/// at both ends; powers are integrated by Gauss' rule. The difference D from the same with cubics,
/// without accelerations, estimates the error: cubics and quintics miss an oscillation of omega h
/// by (omega h)^4/384 and (omega h)^6/46080, so that the quintics' share of the integral I is below
/// (D/I)^(3/2). Where that is above the tolerance the step is halved, with states that the
/// integrator gives for times within it. Integrators that have a closed form
/// (Integrator::integrate_squared_velocities) give the beam's part.
class LossQuadrature {
 public:
  /// `tolerance` of a step's integral, J.
  explicit LossQuadrature(double tolerance) : tolerance_(tolerance) {}

  /// What is lost from the start of the step to a time t within it or at its end, where the state
  /// is y.
  Losses over(const ObservedStep& step, double t, const State& y, StruckBeam& beam);

 private:
  struct Node {
    double time;
    State y;
    std::vector<double> acceleration;
  };
  static void read_acceleration(Node& node, StruckBeam& beam);
  Losses halved(const Node& a, const Node& b, const ObservedStep& step, StruckBeam& beam,
                int depth);
  // By quintics, or by cubics.
  Losses between(const Node& a, const Node& b, bool quintic, StruckBeam& beam);

  double tolerance_;
  bool beam_by_quadrature_ = false;
  State state_;  // between nodes
  std::vector<double> squares_;
};

}  // namespace subimpact
