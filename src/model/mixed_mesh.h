#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "numerics/lanes.h"
#include "numerics/mass_solver.h"
#include "subimpact/model/beam_mesh.h"

namespace subimpact {

/// Cells between nodes, with the displacement w at the nodes and the bending moment M linear
/// between them (docs/theory.md, "Mixed cells"): for beams of Rayleigh's theory, fourth order in
/// the cell's length h while nothing flows. A node lies under the strike; where it is not at a
/// whole number of cells, those on its two sides differ slightly in length. In the symmetric half
/// model the last node is at mid-span.
///
/// With the jump of slope K w at a node (of the lines between nodes), hat functions N_i and the
/// integral p of the plastic curvature weighted by them,
///
///     T M = E I (K w - p),   T_ij = integral N_i N_j dx,
///     Mass w'' = -K^T M + S F,   Mass = diag(rho A g) + J G^T ((1 - a) L^-1 + a) G,
///
/// with the weights g (m) of a quadrature of fourth order between nodes, the slopes G w of the
/// links and L = (1, 4, 1)/6 between links. Here a = (1 - s^2)/2, where s is the step of central
/// differences over the natural step h/c, c^2 = E/rho: the errors that rotary inertia leaves in
/// space and the step leaves in time then cancel. Methods that leave no such error take s = 0.
/// Steps above h/c, which is stable, are not for this mesh.
///
/// As a BeamMesh its sections are the nodes with a moment and its curvatures T^-1 K w, those of
/// M/(E I) while nothing has flowed. Its weights W are the widths of the hats: moments by them are
/// exact for forces, not for energies (MixedSections).
class MixedMesh final : public BeamMesh {
 public:
  static constexpr std::size_t fewest_cells = 16;
  /// Cells between a strike and an end, at least.
  static constexpr std::size_t fewest_beside = 8;

  /// `position` is the struck point as a fraction of the length, `step_ratio` s. Throws
  /// std::invalid_argument for too few cells, for a half model of an odd number of cells, of unlike
  /// ends or struck off mid-span, for a beam without rotary inertia, for s not from 0 to 1.
  MixedMesh(const Beam& beam, double position, std::size_t n_cells, Extent extent,
            double step_ratio = 1.0);

  /// Cells before the strike, of `n_cells`.
  static std::size_t cells_before(double position, std::size_t n_cells);
  /// h/c of the shorter cells, s.
  static double natural_step_of(const Beam& beam, double position, std::size_t n_cells);

  std::optional<double> natural_step() const override { return step_; }
  void curvatures(std::span<const double> unknowns, std::span<double> kappa) const override;
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override;
  std::unique_ptr<MassSolver> make_mass_solver() const override;
  void moment_weights(std::span<const double> unknowns, std::span<double> weights) const override;
  double curvature(std::size_t section, std::span<const double> unknowns) const override;
  SparseFunctional curvature_functional(std::size_t section) const override;
  std::optional<SparseFunctional> displacement_at(double x) const override;
  std::optional<SparseFunctional> rotation_at(double x) const override;
  double highest_frequency(double bending_stiffness) const override;
  NaturalModes natural_modes(double bending_stiffness) const override;
  std::string description() const override;

  /// Rigid motions of the beam with its supports, and Mass times each; phi^T Mass phi = 1.
  struct RigidMotion {
    std::vector<double> shape, inertia;
  };
  std::vector<RigidMotion> rigid_motions() const;
  /// Moments M (N m) with K^T M = `forces` (N), forces on the unknowns that do no work in rigid
  /// motions; where supports leave a choice, those of the least M^T T M.
  std::vector<double> moments_under(std::span<const double> forces) const;
  /// sum M^T T M of moments at the nodes with a moment, of the whole beam.
  double square_of(std::span<const double> moments) const;

  /// Kinetic energy, J; `scratch` of n_kept_cells() entries.
  double kinetic_energy(std::span<const double> velocities, std::span<double> scratch) const;
  /// jumps = K w - p at the nodes with a moment, rad.
  void jumps(const double* unknowns, const double* p, double* result) const;
  /// Solves T x = b, in place.
  void solve_hats(std::span<double> x) const { hats_->solve(x); }
  /// forces = -factor K^T M, N.
  void forces_of(const double* moments, double factor, double* forces) const;

  /// Nodes: those with an unknown are first_unknown() .. first_unknown() + n_unknowns() - 1, those
  /// with a moment first_moment() .. first_moment() + n_sections() - 1.
  std::size_t first_unknown() const { return first_unknown_; }
  std::size_t first_moment() const { return first_moment_; }
  std::size_t n_kept_cells() const { return lengths_.size(); }
  double cell_length(std::size_t cell) const { return lengths_[cell]; }
  double rotary_inertia() const { return rotary_inertia_; }    ///< J, kg m
  double mass_per_length() const { return mass_per_length_; }  ///< kg/m
  double share_of_links() const { return share_of_links_; }    ///< a
  double copies_of_part() const { return copies(); }
  std::size_t struck_node() const { return struck_node_; }
  bool is_clamped(std::size_t node) const;
  /// Whether an ideal hinge may form at a node: at the strike and at clamped ends.
  bool may_hinge(std::size_t node) const { return node == struck_node_ || is_clamped(node); }
  double node_position(std::size_t node) const { return node_positions_[node]; }  ///< m

 private:
  class Solver;
  class SolverOfSharedLinks;
  // Of values at all nodes, linear between them: the integral of the product.
  double product(std::span<const double> a, std::span<const double> b) const;
  void place_nodes(double length, double position);
  void weigh_nodes();
  void assemble_hats();
  void assemble_functionals();
  SparseFunctional node(std::size_t i) const;
  std::pair<std::size_t, double> place_of(double x) const;
  // L with the lengths of the links, and `inertia` over the masses at their ends.
  BandedMatrix link_matrix(double inertia) const;
  double displacement(const double* unknowns, std::size_t node) const;  // zero where it is held

  std::size_t n_cells_;
  std::array<EndSupport, 2> ends_;  // the second: of the whole beam
  double mass_per_length_, rotary_inertia_, share_of_links_;
  double step_;
  std::size_t struck_node_;
  std::size_t first_unknown_, first_moment_;
  std::vector<double> node_positions_, node_masses_;  // of all nodes kept
  AlignedVector lengths_, inverse_lengths_;           // of cells
  std::unique_ptr<const BandedSolver> hats_;          // T
  std::unique_ptr<const BandedSolver> slopes_;        // L, times lengths
};

}  // namespace subimpact
