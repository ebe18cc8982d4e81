#include "numerics/dense.h"

#include <Eigen/Eigenvalues>

#include <stdexcept>

namespace subimpact {
namespace {

template <class Solver>
EigenPairs pairs_of(const Solver& solver) {
  if (solver.info() == Eigen::Success) return {solver.eigenvalues(), solver.eigenvectors()};
  throw std::runtime_error("an eigenvalue decomposition did not converge");
}

using Symmetric = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
using Generalised = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>;

}  // namespace

EigenPairs eigen_pairs(const Eigen::MatrixXd& matrix) { return pairs_of(Symmetric(matrix)); }

EigenPairs eigen_pairs(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass) {
  return pairs_of(Generalised(stiffness, mass));
}

double largest_eigenvalue(const Eigen::MatrixXd& matrix) {
  return Symmetric(matrix, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

double largest_eigenvalue(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass) {
  return Generalised(stiffness, mass, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

double largest_eigenvalue(std::span<const double> diagonal, std::span<const double> beside) {
  const auto n = static_cast<Eigen::Index>(diagonal.size());
  Symmetric solver;
  solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), n),
                                Eigen::Map<const Eigen::VectorXd>(beside.data(), n - 1),
                                Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

}  // namespace subimpact
