#pragma once

#include <array>
#include <vector>

#include "subimpact/model/beam_mesh.h"

namespace subimpact {

/// N equal cells of length dx = l/N with the displacement at their centres, second order in dx.
///
///     kappa_i = (w[i+1] - 2 w[i] + w[i-1])/dx^2 at the cells' centres
///     Mass = rho A dx I + (J/dx) L,  L the Laplacian of the chain of cells (tridiagonal)
///
/// Ends lie half a cell outside the outermost centres:
///
///     free     no moment in the end cell, no rotary inertia in its outer half (the paper's)
///     pinned   the displacement is continued antisymmetrically, w[-1] = -w[0]; so
///              kappa_0 = (w[1] - 3 w[0])/dx^2
///     clamped  the displacement is continued symmetrically, w[-1] = w[0]; w = 0 at the end of the
///              parabola through the first centres, w[0] = w[1]/9, so w[0] is not an unknown
///
/// With the spacing `points`, for free ends, dx = l/(N - 1): the outermost centres are the ends of
/// the beam, and the outer halves of the end cells lie beyond them. These are the equations of a
/// beam that is longer and heavier by the part 1/(N - 1), an error of first order; the published
/// run has them.
///
/// A strike between two centres is shared between them by linear weights. In the symmetric half
/// model (strike at mid-span, N odd, ends alike) the last unknown is the struck cell, N/2.
class CellMesh final : public BeamMesh {
 public:
  enum class Extent { whole, half };
  enum class Spacing { cells, points };

  static constexpr std::size_t fewest_cells = 5;
  static constexpr std::size_t fewest_cells_if_clamped = 7;

  /// `position` is the struck point as a fraction of the length. Throws std::invalid_argument for
  /// too few cells, for a half model of an even number of cells, of unlike ends or struck off
  /// mid-span, for the spacing `points` with supports.
  CellMesh(const Beam& beam, double position, std::size_t n_cells, Extent extent,
           Spacing spacing = Spacing::cells);

  /// dx, m.
  static double spacing_of(const Beam& beam, std::size_t n_cells, Spacing spacing);

  void curvatures(std::span<const double> unknowns, std::span<double> kappa) const override;
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override;
  /// Linear between centres, as the strike is shared between them.
  std::optional<SparseFunctional> displacement_at(double x) const override;
  /// Linear between the faces of cells, where it is the difference of the centres beside them.
  std::optional<SparseFunctional> rotation_at(double x) const override;
  /// (4 c/dx^2)/sqrt(1 + 4 r^2/dx^2) with c = sqrt(E I/(rho A)): the infinite grid's. Supported
  /// ends are constraints on mirrored grids, which cannot exceed it.
  double highest_frequency(double bending_stiffness) const override;
  /// In closed form if both ends are free (see free_cell_modes).
  NaturalModes natural_modes(double bending_stiffness) const override;
  bool has_closed_modes() const override;
  std::string description() const override;

 private:
  // One section at a supported end: its curvature from the two outermost unknowns, outer first.
  using EndStencil = std::array<double, 2>;

  SparseFunctional cell(std::size_t i) const;
  SparseFunctional continued_cell(long i) const;
  void assemble_mass();
  void assemble_moment();
  void place_sections();
  void place_strike(double position);

  std::size_t n_cells_;
  double spacing_;
  double first_centre_;  // its distance from the end of the beam, in spacings
  double mass_per_length_;
  double rotary_inertia_;
  std::array<EndSupport, 2> ends_;
  std::vector<EndStencil> first_sections_;  // outermost first
  std::vector<EndStencil> last_sections_;   // outermost last; unknowns in order
};

}  // namespace subimpact
