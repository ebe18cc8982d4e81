#pragma once

#include <span>
#include <vector>

#include "numerics/lanes.h"
#include "subimpact/numerics/banded_matrix.h"

namespace subimpact {

/// Solves Mass x = b with a Cholesky factorisation of a banded matrix, arranged so that its
/// recurrences run block by block.
///
/// With A = L L^T, L lower-banded, cut into blocks of 8 unknowns, forward substitution reads y_b =
/// D_b^-1 b_b - P_b (last unknowns of y_{b-1}) with D_b^-1 and P_b = D_b^-1 C_b formed once, and
/// backward substitution likewise. The products are independent of the recurrence and vectorise, so
/// that the chain of dependent operations is one multiply-add per block instead of one per unknown.
/// A tridiagonal matrix needs no full D_b^-1: three multiply-adds with shifted blocks are enough.
/// A diagonal matrix needs none of this. For half bandwidths up to 3. Throws std::invalid_argument
/// if the matrix is not positive definite.
class BandedSolver {
 public:
  explicit BandedSolver(const BandedMatrix& matrix);
  /// Overwrites the right-hand side with the solution.
  void solve(std::span<double> x) const;

 private:
  template <std::size_t width>
  void solve_with(double* x) const;

  std::size_t size_;
  std::size_t n_blocks_;
  std::size_t half_bandwidth_;
  // Coefficients of each distinct block, downwards and upwards, see BlockStep.
  AlignedVector coefficients_;
  std::vector<std::size_t> down_, up_;  // where those of each block begin
};

}  // namespace subimpact
