#pragma once

#include <cstddef>

#include "subimpact/model/beam_mesh.h"

namespace subimpact {

/// A chain of equal cells with free ends (see CellMesh).
struct CellChain {
  std::size_t n_cells;
  double spacing;            ///< dx, m
  double mass_per_length;    ///< rho A, kg/m
  double rotary_inertia;     ///< J, kg m
  double bending_stiffness;  ///< E I, N m2
};

/// Its natural modes in closed form (docs/theory.md, "Cells"); work n^2 for n shapes. Rigid
/// translation and rotation come first. Shapes are not normalised. Mode k of the result has entries
/// for cells 0, 1, ..., n_kept - 1.
NaturalModes free_cell_modes(const CellChain& chain, bool symmetric_only, std::size_t n_kept);

}  // namespace subimpact
