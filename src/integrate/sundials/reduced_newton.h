#pragma once

#include <vector>

#include "integrate/sundials/sparse.h"
#include "integrate/sundials/vector.h"
#include "ode/integrator.h"

namespace subimpact {

/// A linear solver for CVODE's (I - gamma J) x = b on y' = [v, Mass^-1 f(q, v)]: half the
/// unknowns, and sparse although Mass^-1 K is full (see make_cvode_bdf). To CVODE it is a direct
/// solver whose matrix is Mass + gamma C + gamma^2 K.
class ReducedNewton {
 public:
  ReducedNewton(MechanicalSystem& system, SUNContext context);
  ReducedNewton(const ReducedNewton&) = delete;
  ReducedNewton& operator=(const ReducedNewton&) = delete;

  SUNMatrix matrix() const { return matrix_.get(); }
  SUNLinearSolver solver() const { return solver_.get(); }

  /// Takes K and C at y.
  void update_tangents(std::span<const double> y);
  /// Makes the matrix of `gamma` from the tangents last taken, for a factorisation.
  void assemble(double gamma);

  void add_counts(WorkCounts& counts) const;

 private:
  static SUNLinearSolver_Type type(SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; }
  static int set_up(SUNLinearSolver solver, SUNMatrix matrix);
  static int solve(SUNLinearSolver solver, SUNMatrix matrix, N_Vector x, N_Vector b, sunrealtype);
  static int free(SUNLinearSolver solver);

  MechanicalSystem& system_;
  const SparsityPattern& pattern_;
  std::vector<double> mass_, stiffness_;
  std::vector<double> damping_;  // empty without forces of velocity
  double gamma_ = 0.0;
  VectorPointer right_side_, velocities_;  // of the reduced system
  MatrixPointer matrix_;
  LinearSolverPointer klu_;
  LinearSolverPointer solver_;
  long stiffness_updates_ = 0;
  long assemblies_ = 0;
  long analyses_ = 0;
};

}  // namespace subimpact
