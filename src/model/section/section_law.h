#pragma once

#include <vector>

#include "subimpact/model/scene.h"
#include "subimpact/model/section/fibres.h"

namespace subimpact {

/// The history of the plastic bending of a section. Curvatures x in units of kappa_y, moments m =
/// M/M_y, work in units of M_y kappa_y per length.
struct SectionHistory {
  struct Point {
    double x, m;
  };
  std::vector<Point>
      reversals;         ///< reversal points still in force, alternating, ever closer together
  Point edge{0.0, 0.0};  ///< end of the last flow; perhaps the next reversal point
  int direction = 0;     ///< sense of the last flow, +1 or -1; 0: has never yielded
  double work = 0.0;     ///< integral of m dx up to the edge
  double work_of_branch = 0.0;  ///< that part which was done on the branch of the edge
};

/// Energies of bending, J, or J/m of a section.
struct BendingEnergies {
  double elastic = 0.0, plastic = 0.0;

  void add(double factor, const BendingEnergies& more) {
    elastic += factor * more.elastic;
    plastic += factor * more.plastic;
  }
};

/// Curvatures (1/m) between which no fibre of a section flows: there M = stiffness kappa - offset.
struct ElasticWindow {
  double low, high;
  double offset;  ///< N m
};

/// The curve a flowing section moves along until it reverses or closes a loop: from `origin` (or
/// the virgin curve), in units of kappa_y and M_y.
struct SectionBranch {
  SectionHistory::Point origin;
  double sense;  ///< of the flow, +1 or -1
  bool virgin;
  double limit;  ///< 1/m: curvature at which the branch ends on an older one; infinite: nowhere
};

/// Moment of a section whose fibres are elastic-perfectly plastic, with memory (docs/theory.md,
/// "Bending with yield"). Bending moment M in N m, with the sign of the curvature (1/m). All
/// functions are const in the history; `commit` alone advances it, at accepted states. Curvature is
/// taken to move monotonically between two commits.
class SectionLaw {
 public:
  /// `fibres` of a section of `beam`; the yield stress must be finite.
  SectionLaw(const Beam& beam, const Fibres& fibres);

  const Fibres& fibres() const { return fibres_; }

  /// dM/dkappa while nothing flows, N m2 (that of the fibres: slightly below E I for layers).
  double stiffness() const { return stiffness_; }

  ElasticWindow window(const SectionHistory& history) const;

  double moment(const SectionHistory& history, double curvature) const;   ///< M, N m
  double tangent(const SectionHistory& history, double curvature) const;  ///< dM/dkappa, N m2
  /// M of a section outside its window, N m.
  double flowing_moment(const SectionHistory& history, double curvature) const;

  SectionBranch branch_from_edge(const SectionHistory& history) const;
  double moment_on(const SectionBranch& branch, double curvature) const;   ///< M, N m
  double tangent_on(const SectionBranch& branch, double curvature) const;  ///< dM/dkappa, N m2

  /// Takes the curvature as reached. Inside the window nothing changes.
  void commit(SectionHistory& history, double curvature) const;

  /// Bending work per length done up to this curvature, J/m. Reached monotonically from the edge.
  double work(const SectionHistory& history, double curvature) const;
  /// Its recoverable part: integral sigma^2/(2E) dA, J/m. The rest is plastic work.
  double elastic_energy(const SectionHistory& history, double curvature) const;

  /// Stress of the outermost fibre on the side z > 0 (away from the striker), Pa.
  double outer_stress(const SectionHistory& history, double curvature) const;

 private:
  SectionBranch branch_at(const SectionHistory& history, double x) const;
  // Moment, and work from the origin on.
  Fibres::Response branch_response(const SectionBranch& branch, double x) const;
  bool inside_window(const SectionHistory& history, double x) const;
  // Visits the zones of fibres from the first to yield inwards: visit(a, b, constant, slope),
  // stress/Y = constant + slope zeta for a < zeta <= b; stops when it returns false.
  template <class Visit>
  void for_each_zone(const SectionHistory& history, double x, Visit visit) const;

  Fibres fibres_;
  double yield_curvature_;
  double yield_moment_;
  double yield_stress_;
  double stiffness_;
};

}  // namespace subimpact
