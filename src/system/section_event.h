#pragma once

#include <array>
#include <optional>

#include "model/section_field.h"
#include "system/section_path.h"

namespace subimpact {

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

/// Follows one section through a step that began at the last commit.
class SectionFollower {
 public:
  explicit SectionFollower(const SectionField& sections) : sections_(sections) {}

  /// The event of a section on `path`, in a step from t0 (s) of a length (s); nothing if the
  /// section, disturbed by earlier events, stays on its piece. `own_coupling`: curvature
  /// acceleration of the section due to its own moment, 1/(m s2) per N m; its own flow is added to
  /// `path`. `first_event`: part of the step from which on the path is disturbed, at most 1.
  std::optional<SectionEvent> follow(const SectionInStep& section, SectionPath& path,
                                     double own_coupling, double first_event, double t0,
                                     double length);

 private:
  const SectionField& sections_;
  SectionHistory after_reversal_;
};

}  // namespace subimpact
