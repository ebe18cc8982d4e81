#pragma once

#include <optional>
#include <vector>

#include "model/section_field.h"
#include "system/section_event.h"
#include "system/section_influence.h"
#include "system/struck_beam.h"

namespace subimpact {

/// The loads on the sections at one end of a step: W_j times the moments M of the smooth pieces and
/// their rates (N m2, N m2/s), one entry per section, the contact force with its rate (N, N/s), and
/// the shear forces with theirs, one entry per unknown; empty where sections do not shear.
struct SectionLoads {
  std::vector<double> weighted_moments, weighted_moment_rates;
  double force = 0.0, force_rate = 0.0;
  std::vector<double> shear_forces, shear_force_rates;
  explicit SectionLoads(const BeamMesh& mesh)
      : weighted_moments(mesh.n_sections()),
        weighted_moment_rates(mesh.n_sections()),
        shear_forces(mesh.shears() ? mesh.n_unknowns() : 0),
        shear_force_rates(shear_forces.size()) {}
};

/// The section events of a step.
///
/// Within a step every section keeps the smooth piece of its law on which the step began
/// (SectionField::smooth_moments): linear while it rests, one branch while it flows. A section that
/// begins to flow, reverses or closes a loop leaves its piece (SectionEvent).
///
/// Paths are polynomials through both ends of the step: cubic where sides are distinguished, of
/// degree seven where the height of a reversal, which enters the section's history, is read off.
/// An event bends the paths of its own and of other sections,
///
///     change of kappa_j(t) = (B c_i)_j (first moment of the defect up to t)   (c_i:
///     SectionInfluence),
///
/// enough to move reversals, to undo them and to bring new ones about: events are found in their
/// order, each on the path that the earlier ones leave. A path that changes its direction twice is
/// not followed: such a step must be cut.
class SectionEvents {
 public:
  SectionEvents(const SectionField& sections, SectionInfluence& influence)
      : sections_(sections), influence_(influence), follower_(sections) {}

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
  const SectionBranch* branch_of(std::size_t section) const;
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
  SectionFollower follower_;
  Coupling coupling_;
};

}  // namespace subimpact
