#pragma once

#include <vector>

#include "subimpact/model/fibres.h"
#include "subimpact/model/scene.h"

namespace subimpact {

/// What a section remembers of its plastic bending. Curvatures x in units of kappa_y, moments
/// m = M/M_y, work in units of M_y kappa_y per length.
struct SectionHistory {
  struct Point {
    double x, m;
  };
  std::vector<Point>
      reversals;         ///< turning points still in force, alternating, ever closer together
  Point edge{0.0, 0.0};  ///< where the last flow ended; the next reversal point if it turned
  int direction = 0;     ///< sense of the last flow, +1 or -1; 0: has never yielded
  double work = 0.0;     ///< integral of m dx up to the edge
};

/// Curvatures (1/m) between which none of a section's fibres flows: there M = stiffness kappa -
/// offset.
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

/// Moment of a section whose fibres are elastic-perfectly plastic, with memory.
///
/// The virgin curve is that of the fibres (Fibres). From a reversal point r the branch is
/// m = m_r +- 2 f(|x - x_r|/2) with f the virgin curve (Masing); a branch that reaches the previous
/// reversal point continues the older branch, and beyond the largest amplitude the virgin curve
/// holds again. For such fibres this is no approximation: it is what the sum
/// over the fibres does (a Prandtl-Ishlinskii operator), for the continuous section and for layers
/// alike. After flow in one sense ends at `edge`, nothing flows within 2 x_1 behind it (x_1: first
/// yield).
///
/// Bending moment M in N m, with the sign of the curvature (1/m). All functions are const in the
/// history; `commit` alone advances it, at accepted states. Curvature is taken to move
/// monotonically between two commits.
class SectionLaw {
 public:
  /// `fibres` of a section of `beam`; the yield stress must be finite.
  SectionLaw(const Beam& beam, Fibres fibres);

  const Fibres& fibres() const { return fibres_; }

  /// dM/dkappa while nothing flows, N m2 (that of the fibres: slightly below E I for layers).
  double stiffness() const { return stiffness_; }

  ElasticWindow window(const SectionHistory& history) const;

  double moment(const SectionHistory& history, double curvature) const;   ///< M, N m
  double tangent(const SectionHistory& history, double curvature) const;  ///< dM/dkappa, N m2

  /// The branch on which a section goes on that flows on from the edge of its history.
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
  double branch_moment(const SectionBranch& branch, double x) const;
  double branch_work(const SectionBranch& branch, double from, double to) const;
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
