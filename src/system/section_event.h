#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "model/section_field.h"
#include "numerics/hermite.h"

namespace subimpact {

/// A curvature's change and its slope over a step, at one part s of the step.
struct CurvatureChange {
  double value = 0.0, slope = 0.0;
};

/// The change of a curvature by the defect d of a section's moment that begins at the part `from`
/// of a step: kappa'' = c d, c the coupling (SectionInfluence).
///
/// Two integrals of d over a span of the step are given,
///
///     amount = int d dt,   next_amount = int (t_end - t) d dt,
///
/// which are slope and value of the change at the end of the span. In between the change is taken
/// to begin as the third power of the time since `from`, as it does for a defect that grows in
/// proportion to that time:
///
///     change(u) = u^3 (a + b u),   u = (s - from)/span,
///
/// with a and b such that value and slope at u = 1 are right.
class DefectResponse {
 public:
  /// `from`, `span` in parts of the step, `length` of the step in s.
  DefectResponse(double from, double span, double length, double coupling, double amount,
                 double next_amount)
      : from_(from),
        span_(span),
        cubic_(coupling * (4.0 * next_amount - span * length * amount)),
        quartic_(coupling * (span * length * amount - 3.0 * next_amount)) {}

  /// From the part `until` of the step on, the curvature is no longer driven.
  void stop_at(double until) { until_ = until; }

  void add_to(CurvatureChange& sum, double s) const {
    if (s <= from_) return;
    const double u = (std::min(s, until_) - from_) / span_;
    sum.value += u * u * u * (cubic_ + u * quartic_);
    if (s <= until_) sum.slope += u * u * (3.0 * cubic_ + u * 4.0 * quartic_) / span_;
  }

 private:
  double from_, span_;
  double until_ = 1.0;
  double cubic_, quartic_;
};

/// One section's curvature (1/m) over a step as a function of the part s of the step, 0 to 1: the
/// path between the ends of the step that it would take without section events, and what events
/// change in it.
class SectionPath {
 public:
  /// Starts anew with a path without events.
  void reset(const HermiteSeptic& undisturbed) {
    undisturbed_ = undisturbed;
    others_.clear();
    own_.reset();
  }
  void add_other(const DefectResponse& response) { others_.push_back(response); }
  void set_own(const DefectResponse& response) { own_ = response; }
  /// The section's own flow ends where its curvature reverses.
  void stop_own_at(double s) {
    if (own_) own_->stop_at(s);
  }

  double undisturbed(double s) const { return undisturbed_(s); }
  double value(double s) const { return undisturbed_(s) + change(s).value; }
  double slope(double s) const { return undisturbed_.slope(s) + change(s).slope; }

  /// By the events of other sections.
  CurvatureChange change_by_others(double s) const {
    CurvatureChange sum;
    for (const DefectResponse& response : others_) response.add_to(sum, s);
    return sum;
  }
  CurvatureChange change(double s) const {
    CurvatureChange sum = change_by_others(s);
    if (own_) own_->add_to(sum, s);
    return sum;
  }

 private:
  HermiteSeptic undisturbed_{{}, {}, 1.0};
  std::vector<DefectResponse> others_;
  std::optional<DefectResponse> own_;
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
