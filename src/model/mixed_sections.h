#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/flow_equations.h"
#include "model/mixed_mesh.h"
#include "model/sub_cell_sections.h"

namespace subimpact {

/// Bending of a beam of mixed cells: moments, plastic curvature on sub-cell sections, ideal hinges,
/// and the displacement that the inertia of plastic curvature adds (docs/theory.md, "Mixed cells").
///
/// Equations of motion hold for y, displacements are w = y + s:
///
///     T M = E I (K w - p),   Mass s = J h^2 K^T T^-1 (p/6 - b) - rho A h^2 (p/12 - b),
///     p_i = integral N_i kappa_p dx + alpha_i,   b_i = integral beta(N_i) kappa_p dx,
///
/// with beta(a) = (a - a^3)/6, kappa_p = kappa_p(M) at the sub-cell sections and the rotation alpha
/// of ideal hinges, which turn at |M| = M_p only. All but kappa_p(M) is linear, so that p and b of
/// the few nodes next to flow follow from as many equations (FlowEquations).
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
  /// Whether anything flows on the way to the state last settled or evaluated.
  bool flows() const { return flowed_; }
  /// Evaluates unknowns that have been settled, and does not change them.
  bool evaluate(std::span<const double> unknowns) { return solve(unknowns.data(), nullptr); }
  /// Makes the evaluated state the history; `contact_force` (N) acts on it. Returns whether
  /// anything flowed on the way to it.
  bool commit(double contact_force);
  /// Histories at the last commit, and the state there, which is then the one last evaluated.
  void exchange(Snapshot& snapshot);
  /// forces = -K^T M, N, if nothing flows.
  void resting_forces(std::span<const double> unknowns, std::span<double> forces);
  /// Unknowns at rest become the history. Returns the first section that would yield there, or
  /// their number.
  std::size_t rest_at(std::span<const double> unknowns);

  // The following functions are for the state last settled or evaluated.

  /// M/(E I), 1/m, at the mesh's sections.
  std::span<const double> elastic_curvatures() const { return elastic_; }
  /// Curvatures (1/m; elastic, and plastic averaged over the hats of the mesh's sections) and
  /// moments (N m).
  void read_bending(std::span<double> curvatures, std::span<double> moments) const;
  /// Stress (Pa) of the outermost fibre away from the striker; `outer_stiffness` = E h/2, N/m.
  double outer_stress_at_strike(double outer_stiffness) const;
  BendingEnergies energies() const;

  /// Kinetic energy (J) of y, with the work that forces have done on w - y = s up to the last
  /// commit.
  double kinetic_energy(std::span<const double> velocities) const {
    return mesh_.kinetic_energy(velocities, scratch_) + work_on_shift_;
  }
  /// The cost of flow so far, in evaluations of a cell's acceleration.
  double flow_work() const { return flow_ ? flow_->equations.work() : 0.0; }
  /// Sections of the mesh in whose hats something has flowed.
  std::size_t n_yielded() const;

 private:
  // The part that only a beam that may yield needs.
  struct Flow {
    Flow(const MixedMesh& mesh, const SectionLaw& law)
        : cells(mesh, law), equations(mesh, cells, law.window({}).high) {}
    SubCellSections cells;
    FlowEquations equations;
  };
  bool solve(const double* unknowns, double* moved);
  bool find_active();
  void activate(std::size_t index);
  SubCellSections::Ends moments_at(std::size_t cell) const;
  void narrow_windows(std::size_t cell);
  void add_work_on_shift(double contact_force);

  const MixedMesh& mesh_;
  double stiffness_;
  double yield_curvature_;
  std::unique_ptr<Flow> flow_;
  // At sections: M/(E I) now, at the last commit and the one before; between these nothing flows.
  AlignedVector elastic_, before_, earlier_, low_, high_;
  AlignedVector p_;             // at the last commit, rad
  AlignedVector shift_;         // s - s at the last commit, where anything flows
  AlignedVector forces_;        // of unknowns; work space
  double force_before_ = 0.0;   // N
  double work_on_shift_ = 0.0;  // J
  bool flowed_ = false;
  std::vector<std::size_t> active_, flowing_;  // cells: in the equations; those of the last commit
  std::vector<char> is_active_;                // of each cell made
  mutable std::vector<double> scratch_;
};

}  // namespace subimpact
