#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "model/section/section_field.h"
#include "numerics/hermite.h"
#include "numerics/mass_solver.h"
#include "subimpact/model/mesh/beam_mesh.h"
#include "system/section/section_path.h"
#include "system/struck_beam.h"

namespace subimpact {

/// Acceleration c_i = Mass^-1 (-B^T W e_i) of the unknowns (1/s2 per N m) due to a moment of 1 N m
/// at section i, and B c_i, by which the section's curvature responds to all moments and forces
/// without a mass solve (docs/theory.md, "Section events"). Entries below rounding are left out.
/// Its first use computes it, with one mass solve.
class SectionInfluence {
 public:
  SectionInfluence(const BeamMesh& mesh, const BandedSolver& mass_solver);

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
  const BandedSolver& mass_solver_;
  std::vector<int> slot_;  // index into known_, -1: not computed yet
  std::vector<Influence> known_;
};

/// One section that may leave, within a step, the smooth piece of its law on which the step began.
/// All times in parts of the step.
struct SectionInStep {
  std::size_t section;
  const SectionBranch* branch;  ///< on which it flows; none: within its window
  double sense;                 ///< of its motion before a reversal, +1 or -1
  double leaves;                ///< when its undisturbed path leaves the piece, at most `reverses`
  std::optional<double> reverses;  ///< when its undisturbed path reverses, if it does
};

/// An event of one section within a step: the section left the smooth piece of its law.
///
/// From `start` on, the moment of the piece was wrong by the defect
///
///     d(t) = M(kappa(t), history) - M_piece(kappa(t)),
///
/// without the linear response (`tangent`) of the piece to changes of kappa by events.
struct SectionEvent {
  std::size_t section;
  double start;  ///< s: when the section left its piece
  struct Reversal {
    double time;       ///< s
    double curvature;  ///< 1/m
  };
  std::optional<Reversal> reversal;
  double tangent;  ///< dM/dkappa at the step's end, N m2
  /// Terms of the expansion of the beam's response, two moments each: for velocity and position.
  static constexpr std::size_t most_terms = 4;
  /// k-th moment of the defect, int (t1 - t)^k/k! d(t) dt over the step, N m s^(k+1).
  std::array<double, 2 * most_terms> defect_moments;
};

/// The event of a section on `path`, in a step from t0 (s) of a length (s) that began at the last
/// commit; nothing if the section, disturbed by earlier events, stays on its piece. `own_coupling`:
/// curvature acceleration of the section due to its own moment, 1/(m s2) per N m; its own flow is
/// added to `path`. `first_event`: part of the step from which on the path is disturbed, at most 1.
std::optional<SectionEvent> follow_section(const SectionField& sections,
                                           const SectionInStep& section, SectionPath& path,
                                           double own_coupling, double first_event, double t0,
                                           double length);

/// The loads on the sections at one end of a step: W_j times the moments M of the smooth pieces and
/// their rates (N m2, N m2/s), one entry per section, the contact force with its rate (N, N/s), and
/// the forces of shear, springs and loads with theirs, one entry per unknown; empty without any.
struct SectionLoads {
  std::vector<double> weighted_moments, weighted_moment_rates;
  double force = 0.0, force_rate = 0.0;
  std::vector<double> shear_forces, shear_force_rates;
  SectionLoads(const BeamMesh& mesh, bool has_loads)
      : weighted_moments(mesh.n_sections()),
        weighted_moment_rates(mesh.n_sections()),
        shear_forces(mesh.shears() || has_loads ? mesh.n_unknowns() : 0),
        shear_force_rates(shear_forces.size()) {}
};

/// The section events of a step (docs/theory.md, "Section events"). Paths are polynomials through
/// both ends of the step: cubic where sides are distinguished, of degree seven where the height of
/// a reversal is read off. A path that changes its direction twice is not followed: such a step
/// must be cut.
class SectionEvents {
 public:
  SectionEvents(const SectionField& sections, SectionInfluence& influence)
      : sections_(sections), influence_(influence) {}

  /// Collects the sections that may leave their pieces in a step of this length (s), begun at the
  /// last commit. Returns whether there are any.
  bool find_candidates(const SectionMotion& start, const SectionMotion& end, double length);
  /// Part of the step after which it must be cut, because a candidate reversed twice.
  std::optional<double> cut() const { return cut_; }

  struct End {
    const SectionMotion& motion;
    const SectionLoads& loads;
  };
  /// Follows the candidates, and sections that they disturb, through the step from t0 to t1 (s).
  void find(const End& start, const End& end, double t0, double t1,
            std::vector<SectionEvent>& events);

  /// How strongly the events found last are coupled, to first order, and the time (s) of the one
  /// that is disturbed most: what earlier events change in its zeroth moment, as the beam's
  /// response to that change (root mean square of velocities, m/s).
  struct Coupling {
    double velocity = 0.0, time = 0.0;
  };
  const Coupling& coupling() const { return coupling_; }

 private:
  struct Candidate {
    SectionInStep in;
    HermiteSeptic path;
  };
  void consider(std::size_t section, const SectionMotion& start, const SectionMotion& end,
                double length);
  HermiteSeptic path_of(std::size_t section, const End& start, const End& end) const;
  std::optional<Candidate> trace(std::size_t section, const End& start, const End& end) const;
  void disturb(std::size_t section, const std::vector<SectionEvent>& events);
  void follow(const Candidate& candidate, std::vector<SectionEvent>& events);
  void find_reversals_by_others(const End& start, const End& end,
                                std::vector<SectionEvent>& events);

  const SectionField& sections_;
  SectionInfluence& influence_;
  double t0_ = 0.0, length_ = 0.0;
  std::vector<std::size_t> candidates_;
  std::optional<double> cut_;
  std::vector<Candidate> traced_;
  struct Disturbance {
    double strength;  // of what it does by the step's end
    DefectResponse response;
  };
  std::vector<Disturbance> disturbances_;
  SectionPath path_;
  Coupling coupling_;
};

}  // namespace subimpact
