#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

namespace subimpact {

// Decompositions of dense matrices. Eigen's templates for them take seconds to compile in each file
// that uses them: they are instantiated here alone, for matrices of any size.

inline Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

/// Eigenvalues in ascending order, and the vectors in the columns of a matrix.
struct EigenPairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// A x = lambda x, A symmetric (its lower half is read): vectors are orthonormal. This and the next
/// throw std::runtime_error if the iteration does not converge.
EigenPairs eigen_pairs(const Eigen::MatrixXd& matrix);

/// K x = lambda M x, both symmetric, M positive definite: x^T M x = 1.
EigenPairs eigen_pairs(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);

/// The largest eigenvalue of the same problems.
double largest_eigenvalue(const Eigen::MatrixXd& matrix);
double largest_eigenvalue(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);

/// That of the symmetric tridiagonal matrix with these entries on the diagonal and beside it, one
/// fewer.
double largest_eigenvalue(std::span<const double> diagonal, std::span<const double> beside);

}  // namespace subimpact
