#pragma once

#include <sundials/sundials_context.h>
#include <sundials/sundials_nvector.h>

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

}  // namespace subimpact
