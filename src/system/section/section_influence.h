#pragma once

#include <cstddef>
#include <vector>

#include "numerics/mass_solver.h"
#include "subimpact/model/mesh/beam_mesh.h"

namespace subimpact {

/// Acceleration c_i = Mass^-1 (-B^T W e_i) of the unknowns (1/s2 per N m) due to a moment of 1 N m
/// at section i, and B c_i, by which the section's curvature responds to all moments and forces
/// without a mass solve (docs/theory.md, "Section events"). Entries below rounding are left out.
/// Its first use computes it, with one mass solve.
class SectionInfluence {
 public:
  SectionInfluence(const BeamMesh& mesh, const MassSolver& mass_solver);

  /// kappa_i'' of one section, given W_j M_j of all (N m2), F and f_s (N; empty: none); 1/(m s2).
  double curvature_acceleration(std::size_t section, const std::vector<double>& weighted_moments,
                                double force, const std::vector<double>& shear_forces);
  /// accelerations += moment c_i.
  void add_accelerations(std::size_t section, double moment, std::vector<double>& accelerations);
  /// (B c_i)_j for i = `section`, j = `other`.
  double curvature_acceleration_at(std::size_t other, std::size_t section);
  /// Root mean square of c_i.
  double strength(std::size_t section) { return of(section).strength; }

 private:
  // The entries from `first` on that are not negligible.
  struct Stretch {
    std::size_t first = 0;
    std::vector<double> values;
    explicit Stretch(const std::vector<double>& whole);
  };
  struct Influence {
    Stretch accelerations, curvatures;
    double strength;
    double at_strike;  // S.c_i
  };
  const Influence& of(std::size_t section);

  const BeamMesh& mesh_;
  const MassSolver& mass_solver_;
  std::vector<int> slot_;  // index into known_, -1: not computed yet
  std::vector<Influence> known_;
};

}  // namespace subimpact
