#pragma once

#include <optional>
#include <span>
#include <vector>

#include "model/mixed_mesh.h"
#include "model/moment_law.h"
#include "model/plastic_response.h"

namespace subimpact {

/// Bending of a beam of mixed cells: moments, plastic curvature on sub-cell sections, ideal hinges,
/// and the displacement that the inertia of the plastic curvature adds (docs/theory.md, "Mixed
/// cells").
///
/// Equations of motion hold for y, displacements are w = y + s:
///
///     T M = E I (K w - p),   Mass s = J h^2 K^T T^-1 (p/6 - b) - rho A h^2 (p/12 - b),
///     p_i = integral N_i kappa_p dx + alpha_i,   b_i = integral beta(N_i) kappa_p dx,
///
/// with beta(a) = (a - a^3)/6, kappa_p = kappa_p(M) at the sub-cell sections and the rotation alpha
/// of ideal hinges, which turn at |M| = M_p only. All but kappa_p(M) is linear, so that p and b of
/// the few nodes beside flow follow from as many equations, which Newton's method solves.
///
/// Histories advance at commit() only. `mesh` must outlive this.
class MixedSections {
 public:
  /// `stiffness`: E I, N m2; `law`: of an exact rectangle, none for a beam that never yields.
  MixedSections(const MixedMesh& mesh, double stiffness, std::optional<SectionLaw> law);

  const MixedMesh& mesh() const { return mesh_; }

  /// Takes unknowns that have moved without flow since the last commit to where flow takes them,
  /// w += s - s at the last commit. False if the law was not solved.
  bool settle(std::span<double> unknowns) { return solve(unknowns.data(), unknowns.data()); }
  /// The same for unknowns that have been settled, which do not change.
  bool evaluate(std::span<const double> unknowns) { return solve(unknowns.data(), nullptr); }
  /// Of the state last settled or evaluated: M/(E I), 1/m, at the mesh's sections.
  const AlignedVector& elastic_curvatures() const { return elastic_; }
  /// Curvatures (1/m; elastic, and plastic averaged over the hats of the mesh's sections) and
  /// moments (N m).
  void read_bending(std::span<double> curvatures, std::span<double> moments) const;
  /// Of the outermost fibre away from the striker, Pa; `outer_stiffness` = E h/2, N/m.
  double outer_stress_at_strike(double outer_stiffness) const;
  /// That state becomes the history. Returns whether anything flowed on the way to it.
  bool commit();

  struct Energies {
    double elastic = 0.0, plastic = 0.0;  ///< J
  };
  Energies energies() const;
  double kinetic_energy(std::span<const double> velocities) const {  ///< J
    return mesh_.kinetic_energy(velocities, scratch_);
  }
  /// Sections of the mesh in whose hats something has flowed.
  std::size_t n_yielded() const;

  long n_iterations() const { return n_iterations_; }
  long n_solves() const { return n_solves_; }

 private:
  struct Point {
    MomentLaw law;
    double hat[2];     // of the cell's nodes
    double weight[2];  // times the hat, m
    double bubble[2];  // beta of the hat, times the weight
    double moment;     // trial, in M_y
  };
  struct Cell {
    std::size_t cell;
    std::size_t first_point, end_point;
    std::size_t local[2];        // nodes among those of the equations
    double of_p[2][2], of_b[2][2];  // slopes of what its sections add to p and b, over moments
  };
  double moment_in(const Cell& cell, const Point& point) const;
  struct Hinge {
    std::size_t section;
    double rotation = 0.0;  // at the last commit, kappa_y m
    double turned = 0.0;    // since
    double path = 0.0;      // all of it, either way
    double sense = 0.0;     // while it turns, else 0
    double sense_before = 0.0;
    std::size_t local = none;
  };
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  bool solve(const double* unknowns, double* moved);
  bool find_active();
  bool flows(const Cell& cell) const;
  void make_cell(std::size_t cell);
  void bound(const Cell& cell);
  void gather();
  bool newton();
  bool iterate(bool* switched);
  double evaluate_law();
  void assemble();
  void eliminate();
  void advance();
  void descend(double error);
  bool is_inside() const;
  void apply(double* moved);

  const MixedMesh& mesh_;
  double stiffness_;
  std::optional<SectionLaw> law_;
  double yield_curvature_;
  PlasticResponse response_;
  std::vector<std::size_t> cell_of_;  // of each cell of the mesh, its index in cells_
  std::vector<Cell> cells_;
  std::vector<Point> points_;
  std::vector<Hinge> hinges_;
  AlignedVector low_, high_;                   // of M/(E I) at nodes, within which nothing flows
  AlignedVector p_;                            // at the last commit, rad
  AlignedVector elastic_, before_, earlier_;   // M/(E I): now, at the last commit, the one before
  bool flowed_ = false;
  bool coupled_ = true;                        // settling, not evaluating
  // The equations.
  std::vector<std::size_t> active_, flowing_;  // indices of cells
  std::vector<std::size_t> gathered_;          // the active ones of the present equations
  std::vector<std::size_t> nodes_;             // their sections
  bool gathered_coupled_ = true;
  std::vector<double> moment_, elastic_moment_, p_new_, b_new_, residual_, step_;
  std::vector<double> of_p_, of_b_;            // M/M_y of the nodes' p and b, row by row
  std::vector<double> jacobian_;
  long n_iterations_ = 0, n_solves_ = 0;
  mutable std::vector<double> scratch_;
};

}  // namespace subimpact
