#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "model/section_field.h"

namespace subimpact {

/// What one section did in a step that its smooth piece did not know of.
struct SectionKink {
  std::size_t section;
  double start;  ///< s: when it left its piece
  struct Turn {
    double time;       ///< s
    double curvature;  ///< 1/m
  };
  std::optional<Turn> turn;      ///< where it turned back, if it did
  std::array<double, 4> amount;  ///< see SectionKinks, N m s^(k+1)
  double tangent;                ///< -dM/dkappa at the step's end, N m2
};

/// Curvatures (1/m) and their rates at one end of a step, an entry a section.
struct SectionMotion {
  std::vector<double> curvatures, rates;  ///< 1/m, 1/(m s)
  std::vector<double> second, third;      ///< the next two rates; only where they are asked for
  explicit SectionMotion(std::size_t n_sections)
      : curvatures(n_sections), rates(n_sections), second(n_sections), third(n_sections) {}
};

/// The kinks of a step.
///
/// Within a step every section keeps the smooth piece of its law on which the step began
/// (SectionField::smooth_moments): linear while it rests, one branch while it flows. A section that
/// begins to flow, turns back or closes a loop leaves its piece; from there on its moment was wrong
/// by a defect d(t) = M(path) - M(piece), small because little of the step is left. The path
/// kappa(t) is known from the step's ends, so the defect is integrated with the true law, turn
/// included:
///
///     amount_k = integral of (t1 - t)^k/k! d(t) dt,   k = 0..3,
///
/// from which the beam's answer to it follows (StruckBeam::find_section_kinks).
///
/// Paths are polynomials through both ends: cubic where sides are told apart, of degree seven where
/// the height of a turn, which the section will remember, is read off. A path that changes its
/// direction twice is not followed: such a step must be cut.
class SectionKinks {
 public:
  /// Collects the sections of a step of this length, begun at the last commit, that may have left
  /// their pieces. Returns whether there are any. Needs curvatures and rates.
  bool suspect(const SectionField& sections, const SectionMotion& start, const SectionMotion& end,
               double length);
  /// Part of the step after which it must be cut, because a suspect changed direction twice.
  std::optional<double> cut() const { return cut_; }
  /// The kinks of the suspects in the step from t0 to t1. Needs all rates.
  void find(const SectionField& sections, const SectionMotion& start, const SectionMotion& end,
            double t0, double t1);
  void clear() { kinks_.clear(); }
  const std::vector<SectionKink>& kinks() const { return kinks_; }

 private:
  std::vector<std::size_t> suspects_;
  std::optional<double> cut_;
  std::vector<SectionKink> kinks_;
  SectionHistory turned_;
};

}  // namespace subimpact
