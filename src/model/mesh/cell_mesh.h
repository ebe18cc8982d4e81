#pragma once

#include <array>
#include <vector>

#include "subimpact/model/mesh/beam_mesh.h"

namespace subimpact {

/// N equal cells of length dx = l/N with the displacement at their centres, second order in dx, or
/// of dx = l/(N - 1) with the spacing `points` (docs/theory.md, "Cells"). `whole` is `cells` with
/// the rotary inertia of the outer half cells at free ends, which `cells` leaves out. In the
/// symmetric half model (strike at mid-span, N odd, ends alike) the last unknown is the struck
/// cell, N/2.
class CellMesh final : public BeamMesh {
 public:
  enum class Spacing { cells, whole, points };

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
  /// Linear between the faces of cells, where it is the difference of the neighbouring centres.
  std::optional<SparseFunctional> rotation_at(double x) const override;
  std::vector<Slope> slopes() const override;
  /// The infinite grid's, which the constraints of supported ends on mirrored grids cannot exceed.
  double highest_frequency(double bending_stiffness) const override;
  /// In closed form if both ends are free and all links alike (see free_cell_modes).
  NaturalModes natural_modes(double bending_stiffness) const override;
  bool has_closed_modes() const override;
  std::string description() const override {
    return described(n_cells_, first_centre_ == 0.0 ? "points" : whole_ ? "whole cells" : "cells");
  }

 private:
  // One section at a supported end: its curvature from the two outermost unknowns, outer first.
  using EndStencil = std::array<double, 2>;

  SparseFunctional cell(std::size_t i) const;
  SparseFunctional continued_cell(long i) const;
  // The rotary inertia between the cells i and i + 1 over that of a whole length dx.
  double link(std::size_t i) const;
  void assemble_mass();
  void assemble_moment();
  void place_sections();
  void place_strike(double position);

  std::size_t n_cells_;
  double spacing_;
  double first_centre_;  // its distance from the end of the beam, in spacings
  double mass_per_length_;
  double rotary_inertia_;
  bool whole_;
  std::array<EndSupport, 2> ends_;
  std::vector<EndStencil> first_sections_;  // outermost first
  std::vector<EndStencil> last_sections_;   // outermost last; unknowns in order
};

}  // namespace subimpact
