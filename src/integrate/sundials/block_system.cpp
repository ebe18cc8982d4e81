#include "integrate/sundials/block_system.h"

#include <algorithm>

namespace subimpact {

BlockSystem::BlockSystem(MechanicalSystem& system, MechanicalSystem::Part part, N_Vector like,
                         SUNContext context)
    : system_(system),
      part_(part),
      mass_(system.pattern().n_entries()),
      stiffness_(system.pattern().n_entries()) {
  const SparsityPattern& pattern = system.pattern();
  const std::size_t n = pattern.size();
  system.mass_entries(mass_);
  const bool damped = system.depends_on_velocity();
  if (damped) damping_.resize(pattern.n_entries());

  SparsityPattern newton;
  std::vector<double> constants;
  const auto end_column = [](SparsityPattern& of) { of.column_starts.push_back(of.n_entries()); };
  const auto each_entry = [&](std::size_t column, auto visit) {
    for (std::size_t k = pattern.column_starts[column]; k < pattern.column_starts[column + 1];
         ++k) {
      visit(k, n + pattern.rows[k]);
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
  newton_solver_ = make_klu_solver(like, newton_matrix_.get(), context);
  mass_matrix_ = make_sparse_matrix(block_diagonal_, context);
  fill_mass(mass_matrix_.get());
  mass_solver_ = make_klu_solver(like, mass_matrix_.get(), context);
}

void BlockSystem::fill_mass(SUNMatrix mass) const {
  set_pattern(mass, block_diagonal_);
  const auto all = values(mass, block_diagonal_.n_entries());
  const auto lower = std::fill_n(all.begin(), system_.pattern().size(), 1.0);
  std::copy_if(mass_.begin(), mass_.end(), lower, [](double value) { return value != 0.0; });
}

void BlockSystem::update_tangents(std::span<const double> y) {
  system_.stiffness_entries(y, part_, stiffness_);
  if (!damping_.empty()) system_.damping_entries(y, part_, damping_);
  ++stiffness_updates_;
}

void BlockSystem::assemble(double gamma) {
  double* all = values(newton_matrix_.get(), 0).data();
  for (std::size_t k = 0; k < stiffness_.size(); ++k) all[stiffness_at_[k]] = gamma * stiffness_[k];
  for (std::size_t k = 0; k < damping_.size(); ++k) {
    all[damping_at_[k]] = mass_[k] + gamma * damping_[k];
  }
  for (const std::size_t at : gamma_at_) all[at] = -gamma;
  ++assemblies_;
  if (analyses_next(newton_solver_.get())) ++analyses_;
}

void BlockSystem::add_counts(WorkCounts& counts) const {
  counts.jacobians += stiffness_updates_;
  counts.factorisations += assemblies_;
  counts.pattern_analyses += analyses_;
}

}  // namespace subimpact
