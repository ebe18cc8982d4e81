#include "integrate/sundials/newton_matrices.h"

#include <algorithm>
#include <stdexcept>

namespace subimpact {

NewtonMatrices::NewtonMatrices(MechanicalSystem& system)
    : system_(system),
      pattern_(system.pattern()),
      mass_(pattern_.n_entries()),
      stiffness_(pattern_.n_entries()),
      damping_(system.depends_on_velocity() ? pattern_.n_entries() : 0) {
  system.mass_entries(mass_);
}

void NewtonMatrices::update(std::span<const double> y, bool keep_tangents, double gamma) {
  if (!keep_tangents) {
    system_.stiffness_entries(y, stiffness_);
    if (!damping_.empty()) system_.damping_entries(y, damping_);
    ++tangent_updates_;
  }
  assemble(gamma);
  ++assemblies_;
  if (analyses_next(klu_.get())) ++analyses_;
}

void NewtonMatrices::add_counts(WorkCounts& counts) const {
  counts.jacobians += tangent_updates_;
  counts.factorisations += assemblies_;
  counts.pattern_analyses += analyses_;
}

BlockSystem::BlockSystem(MechanicalSystem& system, N_Vector like, SUNContext context)
    : NewtonMatrices(system) {
  const std::size_t n = pattern_.size();
  const bool damped = !damping_.empty();
  SparsityPattern newton;
  std::vector<double> constants;
  const auto end_column = [](SparsityPattern& of) { of.column_starts.push_back(of.n_entries()); };
  const auto each_entry = [&](std::size_t column, auto visit) {
    for (std::size_t k = pattern_.column_starts[column]; k < pattern_.column_starts[column + 1];
         ++k) {
      visit(k, n + pattern_.rows[k]);
    }
  };
  for (std::size_t j = 0; j < n; ++j) {
    newton.rows.push_back(j);
    constants.push_back(1.0);
    each_entry(j, [&](std::size_t, std::size_t row) {
      stiffness_at_.push_back(newton.n_entries());
      newton.rows.push_back(row);
      constants.push_back(0.0);
    });
    end_column(newton);
    block_diagonal_.rows.push_back(j);
    end_column(block_diagonal_);
  }
  for (std::size_t j = 0; j < n; ++j) {
    gamma_at_.push_back(newton.n_entries());
    newton.rows.push_back(j);
    constants.push_back(0.0);
    each_entry(j, [&](std::size_t k, std::size_t row) {
      if (mass_[k] == 0.0 && !damped) return;
      if (damped) damping_at_.push_back(newton.n_entries());
      newton.rows.push_back(row);
      constants.push_back(mass_[k]);
      if (mass_[k] == 0.0) return;
      block_diagonal_.rows.push_back(row);
    });
    end_column(newton);
    end_column(block_diagonal_);
  }

  newton_matrix_ = make_sparse_matrix(newton, context);
  std::copy(constants.begin(), constants.end(),
            values(newton_matrix_.get(), constants.size()).begin());
  klu_ = make_klu_solver(like, newton_matrix_.get(), context);
  mass_matrix_ = make_sparse_matrix(block_diagonal_, context);
  fill_mass(mass_matrix_.get());
  mass_solver_ = make_klu_solver(like, mass_matrix_.get(), context);
}

void BlockSystem::fill_mass(SUNMatrix mass) const {
  set_pattern(mass, block_diagonal_);
  const auto all = values(mass, block_diagonal_.n_entries());
  const auto lower = std::fill_n(all.begin(), pattern_.size(), 1.0);
  std::copy_if(mass_.begin(), mass_.end(), lower, [](double value) { return value != 0.0; });
}

void BlockSystem::assemble(double gamma) {
  double* all = values(newton_matrix_.get(), 0).data();
  for (std::size_t k = 0; k < stiffness_.size(); ++k) all[stiffness_at_[k]] = gamma * stiffness_[k];
  for (std::size_t k = 0; k < damping_.size(); ++k) {
    all[damping_at_[k]] = mass_[k] + gamma * damping_[k];
  }
  for (const std::size_t at : gamma_at_) all[at] = -gamma;
}

ReducedNewton::ReducedNewton(MechanicalSystem& system, SUNContext context)
    : NewtonMatrices(system),
      right_side_(make_vector(pattern_.size(), context, VectorOperations::project)),
      velocities_(make_vector(pattern_.size(), context, VectorOperations::project)),
      matrix_(make_sparse_matrix(pattern_, context)),
      solver_(SUNLinSolNewEmpty(context)) {
  if (!solver_) throw std::runtime_error("SUNLinSolNewEmpty failed");
  klu_ = make_klu_solver(right_side_.get(), matrix_.get(), context);
  solver_->content = this;
  solver_->ops->gettype = type;
  solver_->ops->setup = set_up;
  solver_->ops->solve = solve;
  solver_->ops->free = free;
}

void ReducedNewton::assemble(double gamma) {
  gamma_ = gamma;
  const auto all = values(matrix_.get(), pattern_.n_entries());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = mass_[k] + gamma * gamma * stiffness_[k];
  for (std::size_t k = 0; k < damping_.size(); ++k) all[k] += gamma * damping_[k];
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

}  // namespace subimpact
