#include "integrate/sundials/reduced_newton.h"

#include <algorithm>
#include <stdexcept>

namespace subimpact {

ReducedNewton::ReducedNewton(MechanicalSystem& system, SUNContext context)
    : system_(system),
      pattern_(system.pattern()),
      mass_(pattern_.n_entries()),
      stiffness_(pattern_.n_entries()),
      right_side_(make_vector(pattern_.size(), context, VectorOperations::project)),
      velocities_(make_vector(pattern_.size(), context, VectorOperations::project)),
      matrix_(make_sparse_matrix(pattern_, context)),
      klu_(make_klu_solver(right_side_.get(), matrix_.get(), context)),
      solver_(SUNLinSolNewEmpty(context)) {
  if (!solver_) throw std::runtime_error("SUNLinSolNewEmpty failed");
  solver_->content = this;
  solver_->ops->gettype = type;
  solver_->ops->setup = set_up;
  solver_->ops->solve = solve;
  solver_->ops->free = free;
  system.mass_entries(mass_);
  if (system.depends_on_velocity()) damping_.resize(pattern_.n_entries());
}

void ReducedNewton::update_tangents(std::span<const double> y) {
  system_.stiffness_entries(y, MechanicalSystem::Part::all, stiffness_);
  if (!damping_.empty()) system_.damping_entries(y, MechanicalSystem::Part::all, damping_);
  ++stiffness_updates_;
}

void ReducedNewton::assemble(double gamma) {
  gamma_ = gamma;
  const auto all = values(matrix_.get(), pattern_.n_entries());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = mass_[k] + gamma * gamma * stiffness_[k];
  for (std::size_t k = 0; k < damping_.size(); ++k) all[k] += gamma * damping_[k];
  ++assemblies_;
  if (analyses_next(klu_.get())) ++analyses_;
}

int ReducedNewton::set_up(SUNLinearSolver solver, SUNMatrix matrix) {
  return SUNLinSolSetup(static_cast<ReducedNewton*>(solver->content)->klu_.get(), matrix);
}

int ReducedNewton::solve(SUNLinearSolver solver, SUNMatrix matrix, N_Vector x, N_Vector b,
                         sunrealtype tolerance) {
  const auto& self = *static_cast<const ReducedNewton*>(solver->content);
  const std::size_t n = self.pattern_.size();
  const auto b1 = entries(b).first(n);
  const auto b2 = entries(b).last(n);
  const auto right = entries(self.right_side_.get());
  std::fill(right.begin(), right.end(), 0.0);
  for (std::size_t j = 0; j < n; ++j) {
    const double from_positions = -self.gamma_ * b1[j];
    const double from_velocities = b2[j];
    for (std::size_t k = self.pattern_.column_starts[j]; k < self.pattern_.column_starts[j + 1];
         ++k) {
      right[self.pattern_.rows[k]] +=
          self.mass_[k] * from_velocities + self.stiffness_[k] * from_positions;
    }
  }
  const int flag = SUNLinSolSolve(self.klu_.get(), matrix, self.velocities_.get(),
                                  self.right_side_.get(), tolerance);
  if (flag != 0) return flag;
  const auto velocities = entries(self.velocities_.get());
  const auto x1 = entries(x).first(n);
  const auto x2 = entries(x).last(n);
  for (std::size_t i = 0; i < n; ++i) {
    x1[i] = b1[i] + self.gamma_ * velocities[i];
    x2[i] = velocities[i];
  }
  return 0;
}

int ReducedNewton::free(SUNLinearSolver solver) {
  solver->content = nullptr;  // not the library's to free
  SUNLinSolFreeEmpty(solver);
  return 0;
}

void ReducedNewton::add_counts(WorkCounts& counts) const {
  counts.jacobians += stiffness_updates_;
  counts.factorisations += assemblies_;
  counts.pattern_analyses += analyses_;
}

}  // namespace subimpact
