#pragma once

#include <cmath>

#include "model/section_law.h"

namespace subimpact {

/// The law of a section of a rectangle's elastic-perfectly plastic fibres, with the moment as the
/// variable: what SectionLaw is with the curvature. Between two commits the moment moves
/// monotonically. Moments m = M/M_y, within -1.5 and 1.5; curvatures x and their plastic part x - m
/// in units of kappa_y.
///
/// On a branch from (x_r, m_r): x = x_r + 2 g((m - m_r)/2), on the virgin curve x = g(m), with
/// g(m) = m up to 1 in magnitude and 1/sqrt(3 - 2 |m|) with the sign of m beyond.
class MomentLaw {
 public:
  /// As magnitude of m: of a section that flows throughout.
  static constexpr double limit = 1.5;

  double plastic() const { return plastic_; }  ///< at the last commit
  double low() const { return low_; }          ///< m between which nothing flows
  double high() const { return high_; }
  /// As SectionLaw takes it.
  const SectionHistory& history(const SectionLaw& law, double yield_curvature) const {
    catch_up(law, yield_curvature);
    return history_;
  }

  struct Flow {
    double plastic;  ///< x - m
    double slope;    ///< d(x - m)/dm
  };
  /// For any m within the limits.
  Flow at(double m) const {
    if (m >= low_ && m <= high_) return {plastic_, 0.0};
    const Branch& branch = m > high_ ? rising_ : falling_;
    if (m * branch.sense > branch.end) return beyond(m);
    return on(branch, m);
  }
  /// Takes a moment as reached, by the curvature law of the same section. Returns whether anything
  /// flowed.
  bool commit(double m, const SectionLaw& law, double yield_curvature);

  void exchange(Snapshot& snapshot) {
    snapshot(history_, lags_, edge_, direction_, plastic_, low_, high_, rising_, falling_);
  }

 private:
  // Where a motion beyond the window goes on: up to `end`, times its sense.
  struct Branch {
    double x = 0.0, m = 0.0;
    double scale = 1.0;  // 1 on the virgin curve, else 2
    double sense = 1.0;
    double end = limit;
    void exchange(Snapshot& snapshot) { snapshot(x, m, scale, sense, end); }
  };
  static Flow on(const Branch& branch, double m) {
    const double part = (m - branch.m) / branch.scale;
    const double size = std::abs(part);
    if (size <= 1.0) return {branch.x + branch.scale * part - m, 0.0};
    const double g = 1.0 / std::sqrt(3.0 - 2.0 * size);
    return {branch.x + branch.scale * std::copysign(g, part) - m, g * g * g - 1.0};
  }
  Flow beyond(double m) const;
  Branch branch_to(double m) const;
  void catch_up(const SectionLaw& law, double yield_curvature) const;
  void move_on(SectionHistory::Point to);
  void see_window();

  // Up to the last change of branch, or later; the rest of the way to edge_ is on one branch.
  mutable SectionHistory history_;
  mutable bool lags_ = false;
  SectionHistory::Point edge_{0.0, 0.0};
  int direction_ = 0;
  double plastic_ = 0.0, low_ = -1.0, high_ = 1.0;
  Branch rising_{.sense = 1.0}, falling_{.sense = -1.0};
};

}  // namespace subimpact
