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

/// Owns the object behind a handle of the library; frees it by the library's function.
template <auto free>
struct FreeBy {
  void operator()(auto* object) const { free(object); }
};
template <class Handle, auto free>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, FreeBy<free>>;
using VectorPointer = Owned<N_Vector, N_VDestroy>;
using MatrixPointer = Owned<SUNMatrix, SUNMatDestroy>;
using LinearSolverPointer = Owned<SUNLinearSolver, SUNLinSolFree>;

/// Throws std::runtime_error if SUNDIALS cannot make one.
ContextPointer make_context();

/// A serial vector of n entries; with VectorOperations::project its operations (and those of every
/// vector cloned from it) are the optimised ones compiled here.
VectorPointer make_vector(std::size_t n, SUNContext context, VectorOperations operations);

std::span<double> entries(N_Vector vector);

/// A square sparse matrix (by columns) with the given pattern and zero entries.
MatrixPointer make_sparse_matrix(const SparsityPattern& pattern, SUNContext context);
void set_pattern(SUNMatrix matrix, const SparsityPattern& pattern);
std::span<double> values(SUNMatrix matrix, std::size_t n);

/// KLU on matrices like `matrix`; `like` is a vector of its size.
LinearSolverPointer make_klu_solver(N_Vector like, SUNMatrix matrix, SUNContext context);
/// Whether its next factorisation begins with an analysis of the pattern.
bool analyses_next(SUNLinearSolver klu);

}  // namespace subimpact
