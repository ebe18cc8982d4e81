#pragma once

namespace subimpact {

/// The cost of an integration.
struct WorkCounts {
  long steps = 0;  ///< accepted steps
  long rejected_steps = 0;
  long right_hand_sides = 0;      ///< evaluations of the acceleration
  long partial_steps = 0;         ///< steps retaken to a time inside the last one
  long mass_solves = 0;           ///< beyond those of the accelerations
  long jacobians = 0;             ///< evaluations of the tangent stiffness
  long factorisations = 0;        ///< numerical ones, of Newton matrices
  long pattern_analyses = 0;      ///< symbolic ones: one per matrix
  long nonlinear_iterations = 0;  ///< of implicit methods
  long nonlinear_failures = 0;    ///< their solves that did not converge
};

}  // namespace subimpact
