#pragma once

#include <array>

#include "model/beam_mesh.h"

namespace subimpact {

/// The paper's mesh: N equal cells of length dx = l/N with the displacement at their centres,
/// second order in dx. Free ends.
///
///     kappa_i = (w[i+1] - 2 w[i] + w[i-1])/dx^2 at every inner centre; no moment in the end cells
///     Mass = rho A dx I + (J/dx) L,  L the Laplacian of the chain of cells (tridiagonal)
///
/// A strike between two centres is shared between them by linear weights. In the symmetric half
/// model (strike at mid-span, N odd) the unknowns are w[0..(N-1)/2], the struck cell last.
class CellMesh final : public BeamMesh {
 public:
  enum class Extent { whole, half };

  /// `position` is the struck point as a fraction of the length. Throws std::invalid_argument for
  /// fewer than 5 cells, for a half model of an even number of cells or struck off mid-span.
  CellMesh(const Beam& beam, double position, std::size_t n_cells, Extent extent);

  void curvatures(std::span<const double> unknowns, std::span<double> kappa) const override;
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override;
  SectionStencil section_stencil(std::size_t section) const override;
  /// (4 c/dx^2)/sqrt(1 + 4 r^2/dx^2) with c = sqrt(E I/(rho A)): the infinite grid's.
  double highest_frequency(double bending_stiffness) const override;
  /// In closed form (see free_cell_modes).
  NaturalModes natural_modes(double bending_stiffness) const override;
  std::string description() const override;

 private:
  std::size_t n_cells_;
  double spacing_;
  double mass_per_length_;
  double rotary_inertia_;
  std::array<double, 3> stencil_;         // of an inner cell
  std::array<double, 2> struck_stencil_;  // of the struck cell under symmetry
};

}  // namespace subimpact
