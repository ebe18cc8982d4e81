#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "numerics/hermite.h"

namespace subimpact {

/// A curvature's change and its slope over a step, at one part s of the step.
struct CurvatureChange {
  double value = 0.0, slope = 0.0;
};

/// The change of a curvature by the defect d of a section's moment that begins at the part `from`
/// of a step: kappa'' = c d, c the coupling (SectionInfluence). Of d the integrals amount = int d
/// dt and next_amount = int (t_end - t) d dt over a span of the step are given. The change is taken
/// as u^3 (a + b u), u = (s - from)/span, whose value and slope at u = 1 are right (docs/theory.md,
/// "Section events").
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
/// path between the ends of the step without section events, and what events change in it.
class SectionPath {
 public:
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

}  // namespace subimpact
