#pragma once

#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nvector.h>

#include <cstddef>
#include <memory>
#include <span>

#include "integrate/options.h"

namespace subimpact {

using ContextPointer = std::shared_ptr<std::remove_pointer_t<SUNContext>>;

struct FreeVector {
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
};
using VectorPointer = std::unique_ptr<std::remove_pointer_t<N_Vector>, FreeVector>;

/// Throws std::runtime_error if SUNDIALS cannot make one.
ContextPointer make_context();

/// A serial vector of n entries; with VectorOperations::project its operations (and those of every
/// vector cloned from it) are the optimised ones compiled here.
VectorPointer make_vector(std::size_t n, SUNContext context, VectorOperations operations);

/// The entries of a serial vector.
std::span<double> entries(N_Vector vector);

struct FreeMatrix {
  void operator()(SUNMatrix matrix) const { SUNMatDestroy(matrix); }
};
using MatrixPointer = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, FreeMatrix>;

struct FreeLinearSolver {
  void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
};
using LinearSolverPointer =
    std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, FreeLinearSolver>;

/// A square sparse matrix (by columns) with the given pattern and zero entries.
MatrixPointer make_sparse_matrix(const SparsityPattern& pattern, SUNContext context);
/// Writes the pattern into a matrix that has room for it.
void set_pattern(SUNMatrix matrix, const SparsityPattern& pattern);
/// The first n entries' values.
std::span<double> values(SUNMatrix matrix, std::size_t n);

/// KLU on matrices like `matrix`; `like` is a vector of its size.
LinearSolverPointer make_klu_solver(N_Vector like, SUNMatrix matrix, SUNContext context);
/// Whether its next factorisation begins with an analysis of the pattern.
bool analyses_next(SUNLinearSolver klu);

}  // namespace subimpact
