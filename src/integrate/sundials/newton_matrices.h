#pragma once

#include <vector>

#include "integrate/sundials/linear_algebra.h"
#include "ode/integrator.h"

namespace subimpact {

/// Mass, K and C of a mechanical system in the order of its pattern, of which a solver makes the
/// matrices of Newton's method.
class NewtonMatrices {
 public:
  explicit NewtonMatrices(MechanicalSystem& system);
  NewtonMatrices(const NewtonMatrices&) = delete;
  NewtonMatrices& operator=(const NewtonMatrices&) = delete;

  /// For the library: takes K and C at y, unless those last taken are to be kept, and makes the
  /// matrix of `gamma` of them, for a factorisation.
  void update(std::span<const double> y, bool keep_tangents, double gamma);

  void add_counts(WorkCounts& counts) const;

 protected:
  ~NewtonMatrices() = default;
  virtual void assemble(double gamma) = 0;

  MechanicalSystem& system_;
  const SparsityPattern& pattern_;
  std::vector<double> mass_, stiffness_;
  std::vector<double> damping_;  // empty without forces of velocity
  LinearSolverPointer klu_;      // of the Newton matrix

 private:
  long tangent_updates_ = 0;
  long assemblies_ = 0;
  long analyses_ = 0;
};

/// The matrices of [I, Mass] y' = [v, f(q, v)] as ARKStep needs them, y = [q, v]:
///
///     M = [I, 0; 0, Mass],   M - gamma J = [I, -gamma I; gamma K, Mass + gamma C],
///
/// both sparse, each with a pattern of its own that never changes, so that KLU analyses it once.
class BlockSystem final : public NewtonMatrices {
 public:
  /// `like` is a vector of the state's size.
  BlockSystem(MechanicalSystem& system, N_Vector like, SUNContext context);

  SUNMatrix mass_matrix() const { return mass_matrix_.get(); }
  SUNLinearSolver mass_solver() const { return mass_solver_.get(); }
  SUNMatrix newton_matrix() const { return newton_matrix_.get(); }
  SUNLinearSolver newton_solver() const { return klu_.get(); }

  void fill_mass(SUNMatrix mass) const;

 private:
  void assemble(double gamma) override;

  SparsityPattern block_diagonal_;
  MatrixPointer mass_matrix_, newton_matrix_;
  LinearSolverPointer mass_solver_;
  // Where entries of K and the diagonal -gamma lie in the Newton matrix.
  std::vector<std::size_t> stiffness_at_, damping_at_, gamma_at_;
};

/// A linear solver for CVODE's (I - gamma J) x = b on y' = [v, Mass^-1 f(q, v)]: half the
/// unknowns, and sparse although Mass^-1 K is full (see make_cvode_bdf). To CVODE it is a direct
/// solver whose matrix is Mass + gamma C + gamma^2 K.
class ReducedNewton final : public NewtonMatrices {
 public:
  ReducedNewton(MechanicalSystem& system, SUNContext context);

  SUNMatrix matrix() const { return matrix_.get(); }
  SUNLinearSolver solver() const { return solver_.get(); }

 private:
  void assemble(double gamma) override;
  static SUNLinearSolver_Type type(SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; }
  static int set_up(SUNLinearSolver solver, SUNMatrix matrix);
  static int solve(SUNLinearSolver solver, SUNMatrix matrix, N_Vector x, N_Vector b, sunrealtype);
  static int free(SUNLinearSolver solver);

  double gamma_ = 0.0;
  VectorPointer right_side_, velocities_;  // of the reduced system
  MatrixPointer matrix_;
  LinearSolverPointer solver_;
};

}  // namespace subimpact
