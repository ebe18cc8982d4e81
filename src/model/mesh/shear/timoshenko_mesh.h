#pragma once

#include <array>
#include <vector>

#include "subimpact/model/mesh/beam_mesh.h"

namespace subimpact {

/// N cells of a beam whose sections shear (docs/theory/meshes.md, "Cells that shear").
///
/// Unknowns, from left to right: w[0], r phi[1/2], w[1], r phi[3/2], ..., in m, with the radius of
/// gyration r; so all unknowns of a cell have the same mass. Ends are faces:
///
///     free     no unknown, no moment in the end cell, no shear force at the face; the rotary
///              inertia of the outer half cell is that of the next face, or else the order is one
///     pinned   a rotation phi at the face, of half a cell's inertia; gamma = 2 w[0]/dx - phi
///     clamped  neither; gamma = 2 w[0]/dx
///
/// The struck cell reaches half the length of the cells on either side to its sides. In the half
/// model (strike at mid-span, N odd, ends alike) the last unknown is that of the struck node.
///
/// Source: S. P. Timoshenko, Phil. Mag. 41 (1921) 744.
class TimoshenkoMesh final : public BeamMesh {
 public:
  static constexpr std::size_t fewest_cells = 5;

  /// `position` is the struck point as a fraction of the length. Throws std::invalid_argument for
  /// too few cells, for a half model of an even number of cells, of unlike ends or struck off
  /// mid-span, and for a beam without shear.
  TimoshenkoMesh(const Beam& beam, double position, std::size_t n_cells, Extent extent);

  void curvatures(std::span<const double> unknowns, std::span<double> kappa) const override;
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override;
  void add_shear_forces(std::span<const double> unknowns, std::span<double> forces) const override;
  double shear_energy(std::span<const double> unknowns) const override;
  /// Straight between nodes; at the face of a free end continued from the two nodes next to it.
  std::optional<SparseFunctional> displacement_at(double x) const override {
    return at(displacements_, x);
  }
  /// Straight between faces; constant in the end cell of a free end, where nothing bends.
  std::optional<SparseFunctional> rotation_at(double x) const override { return at(rotations_, x); }
  /// Straight between nodes.
  std::vector<Slope> slopes() const override;
  /// The upper branch of the infinite grid of the shorter cells at its shortest wave.
  double highest_frequency(double bending_stiffness) const override;
  /// From one equation in each frequency if both ends are free and all cells alike.
  NaturalModes natural_modes(double bending_stiffness) const override;
  bool has_closed_modes() const override;
  std::string description() const override {
    return described(sides_[0].n_cells + sides_[1].n_cells + 1, "cells with shear");
  }

 private:
  // Cells of equal length on one side of the strike.
  struct Side {
    double length;  // of a cell, m
    std::size_t n_cells;
  };
  std::size_t node(std::size_t cell) const { return n_before_ + 2 * cell; }  // its unknown
  double cell_length(std::size_t cell) const;
  void assemble_mass();
  void assemble_shear();
  void assemble_moment();
  void place_sections();
  // A place where a displacement or a rotation is an unknown, or follows from the support.
  struct Place {
    double x;  // m
    SparseFunctional value;
  };
  static SparseFunctional between(const Place& before, const Place& after, double x);
  static SparseFunctional at(const std::vector<Place>& places, double x);
  void place_unknowns();
  double node_position(std::size_t i) const;
  double length() const;  // of the whole beam, m
  struct EndFace {
    std::size_t node, rotation;  // unknowns; the rotation of a pinned end only
    double rise, turn;           // gamma = rise w + turn (r phi), 1/m
    double stiffness;            // kGA times the length that the face stands for, N m
    double strain(std::span<const double> unknowns) const {
      return rise * unknowns[node] + (turn != 0.0 ? turn * unknowns[rotation] : 0.0);
    }
  };
  EndFace end_face(std::size_t end) const;

  std::array<Side, 2> sides_;
  std::array<EndSupport, 2> ends_;
  std::size_t n_before_;  // unknowns before the first node: the rotation of a pinned end
  std::size_t n_nodes_;   // kept
  double gyration_;       // r, m
  double mass_per_length_;
  double rotary_inertia_;
  double shear_stiffness_per_length_;  // kGA, N
  std::vector<double> slopes_;         // curvature for a difference of 1 m between unknowns, 1/m2
  // From end to end (or mid-span): nodes with the ends, faces between nodes with the ends.
  std::vector<Place> displacements_, rotations_;
};

}  // namespace subimpact
