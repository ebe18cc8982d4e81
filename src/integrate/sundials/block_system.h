#pragma once

#include <vector>

#include "integrate/sundials/sparse.h"
#include "ode/integrator.h"

namespace subimpact {

/// The matrices of [I, Mass] y' = [v, f(q, v)] as ARKStep needs them, y = [q, v]:
///
///     M = [I, 0; 0, Mass],   M - gamma J = [I, -gamma I; gamma K, Mass + gamma C],
///
/// both sparse, each with a pattern of its own that never changes, so that KLU analyses it once.
class BlockSystem {
 public:
  /// `part` of the force is the implicit one; `like` is a vector of the state's size.
  BlockSystem(MechanicalSystem& system, MechanicalSystem::Part part, N_Vector like,
              SUNContext context);

  SUNMatrix mass_matrix() const { return mass_matrix_.get(); }
  SUNLinearSolver mass_solver() const { return mass_solver_.get(); }
  SUNMatrix newton_matrix() const { return newton_matrix_.get(); }
  SUNLinearSolver newton_solver() const { return newton_solver_.get(); }

  /// Fills M, pattern and all.
  void fill_mass(SUNMatrix mass) const;
  /// Takes K and C at y.
  void update_tangents(std::span<const double> y);
  /// Makes the Newton matrix of `gamma` from the tangents last taken, for a factorisation.
  void assemble(double gamma);

  void add_counts(WorkCounts& counts) const;

 private:
  MechanicalSystem& system_;
  MechanicalSystem::Part part_;
  std::vector<double> mass_, stiffness_;  // in the order of the system's pattern
  std::vector<double> damping_;           // the same; empty without forces of velocity
  SparsityPattern block_diagonal_;
  MatrixPointer mass_matrix_, newton_matrix_;
  LinearSolverPointer mass_solver_, newton_solver_;
  // Where entries of K and the diagonal -gamma lie in the Newton matrix.
  std::vector<std::size_t> stiffness_at_, damping_at_, gamma_at_;
  long stiffness_updates_ = 0;
  long assemblies_ = 0;
  long analyses_ = 0;
};

}  // namespace subimpact
