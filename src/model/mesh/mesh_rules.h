#pragma once

#include "model/rules.h"
#include "subimpact/model/mesh/beam_mesh.h"

namespace subimpact {

/// Throw BrokenRule for a functional, or a row of B, that `n` unknowns cannot have.
void check_functional(const char* name, const SparseFunctional& functional, std::size_t n);
void check_row(std::size_t section, std::size_t first, std::span<const double> row, std::size_t n);

}  // namespace subimpact
