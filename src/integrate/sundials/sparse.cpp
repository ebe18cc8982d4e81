#include "integrate/sundials/sparse.h"

#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>
#include <stdexcept>

#include "integrate/sundials/vector.h"

namespace subimpact {
namespace {

// Replaces the library's product, which Debian compiles without optimisation.
int multiply(SUNMatrix matrix, N_Vector x, N_Vector product) {
  const sunindextype* starts = SUNSparseMatrix_IndexPointers(matrix);
  const sunindextype* rows = SUNSparseMatrix_IndexValues(matrix);
  const double* all = SUNSparseMatrix_Data(matrix);
  const auto in = entries(x);
  const auto out = entries(product);
  std::fill(out.begin(), out.end(), 0.0);
  for (std::size_t j = 0; j < in.size(); ++j) {
    for (sunindextype k = starts[j]; k < starts[j + 1]; ++k) {
      out[static_cast<std::size_t>(rows[k])] += all[k] * in[j];
    }
  }
  return 0;
}

}  // namespace

MatrixPointer make_sparse_matrix(const SparsityPattern& pattern, SUNContext context) {
  const auto n = static_cast<sunindextype>(pattern.size());
  const auto n_entries = static_cast<sunindextype>(pattern.n_entries());
  MatrixPointer matrix(SUNSparseMatrix(n, n, n_entries, CSC_MAT, context));
  if (!matrix) throw std::runtime_error("SUNSparseMatrix failed");
  matrix->ops->matvec = multiply;
  set_pattern(matrix.get(), pattern);
  const auto all = values(matrix.get(), pattern.n_entries());
  std::fill(all.begin(), all.end(), 0.0);
  return matrix;
}

void set_pattern(SUNMatrix matrix, const SparsityPattern& pattern) {
  const auto convert = [](std::size_t i) { return static_cast<sunindextype>(i); };
  std::transform(pattern.column_starts.begin(), pattern.column_starts.end(),
                 SUNSparseMatrix_IndexPointers(matrix), convert);
  std::transform(pattern.rows.begin(), pattern.rows.end(), SUNSparseMatrix_IndexValues(matrix),
                 convert);
}

std::span<double> values(SUNMatrix matrix, std::size_t n) {
  return {SUNSparseMatrix_Data(matrix), n};
}

LinearSolverPointer make_klu_solver(N_Vector like, SUNMatrix matrix, SUNContext context) {
  LinearSolverPointer solver(SUNLinSol_KLU(like, matrix, context));
  if (!solver) throw std::runtime_error("SUNLinSol_KLU failed");
  return solver;
}

bool analyses_next(SUNLinearSolver klu) {
  return static_cast<SUNLinearSolverContent_KLU>(klu->content)->first_factorize != 0;
}

}  // namespace subimpact
