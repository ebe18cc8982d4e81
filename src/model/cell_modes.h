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

/// Its natural modes in closed form, without decomposing a matrix; work n^2 for n shapes.
///
/// With rho = J/(rho A dx^2), a wave cos(theta j) or sin(theta j) along the cells and
/// s = 4 sin^2(theta/2) have omega^2 = E I/(rho A dx^4) s^2/(1 + rho s). At the same frequency the
/// chain also carries cosh(phi j) or sinh(phi j) with 4 sinh^2(phi/2) = sigma = s/(1 + rho s). At
/// the ends there is neither moment nor shear; with c = (n_cells - 1)/2 the distance of an end from
/// the middle that leaves, for symmetric modes cos(theta d) + (1 + rho s) cos(theta c) cosh(phi
/// d)/cosh(phi c), a condition on theta c (end_condition in cell_modes.cpp) with one root in each
/// ((k - 1/2) pi, k pi), and for antisymmetric ones (sin, sinh) one with a root in each (k pi, (k +
/// 1/2) pi), k = 1, 2, ... Rigid translation and rotation come first.
/// Shapes are not normalised. Mode k of the result has entries for cells 0, 1, ..., n_kept - 1.
NaturalModes free_cell_modes(const CellChain& chain, bool symmetric_only, std::size_t n_kept);

}  // namespace subimpact
