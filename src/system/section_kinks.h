#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "model/section_field.h"
#include "numerics/hermite.h"
#include "system/section_influence.h"

namespace subimpact {

/// What one section did in a step that its smooth piece did not know of.
struct SectionKink {
  std::size_t section;
  double start;  ///< s: when it left its piece
  struct Turn {
    double time;       ///< s
    double curvature;  ///< 1/m
  };
  std::optional<Turn> turn;  ///< where it turned back, if it did
  double tangent;            ///< -dM/dkappa at the step's end, N m2
  /// Terms of the expansion of the beam's answer, two amounts each: for velocity and displacement.
  static constexpr std::size_t most_terms = 4;
  std::array<double, 2 * most_terms> amount;  ///< see SectionKinks, N m s^(k+1)
};

/// How a defect d moves what it acts on: its double integral over time, in parts of the step. At
/// the end of its span it has the value and the slope that the integrals of d tell, and it begins
/// as the third power of the time since, as a defect does that grows in proportion to it.
class Growth {
 public:
  /// `amount`, `next_amount`: integrals of d and of (span - s) d over the span.
  Growth(double span, double length, double amount, double next_amount)
      : span_(span),
        cubic_(4.0 * next_amount - span * length * amount),
        quartic_(span * length * amount - 3.0 * next_amount) {}
  double value(double since) const {
    const double u = since / span_;
    return u * u * u * (cubic_ + u * quartic_);
  }
  double slope(double since) const {
    const double u = since / span_;
    return u * u * (3.0 * cubic_ + u * 4.0 * quartic_) / span_;
  }

 private:
  double span_, cubic_, quartic_;
};

/// The sections at one end of a step, an entry each.
struct SectionMotion {
  std::vector<double> curvatures, rates;  ///< 1/m, 1/(m s)
  /// W_j times the moments -M of the smooth pieces and their rates (N m2, N m2/s), and the contact
  /// force with its rate (N, N/s); only where they are asked for.
  std::vector<double> weighted_moments, weighted_moment_rates;
  double force = 0.0, force_rate = 0.0;
  explicit SectionMotion(std::size_t n_sections)
      : curvatures(n_sections),
        rates(n_sections),
        weighted_moments(n_sections),
        weighted_moment_rates(n_sections) {}
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
///     amount_k = integral of (t1 - t)^k/k! d(t) dt,   k = 0..7,
///
/// from which the beam's answer to it follows (StruckBeam::find_section_kinks).
///
/// Paths are polynomials through both ends: cubic where sides are told apart, of degree seven where
/// the height of a turn, which the section will remember, is read off. A kink bends the paths of
/// its own and of other sections,
///
///     change of kappa_j(t) = (B c_i)_j (amount_1 up to t)   (c_i: SectionInfluence),
///
/// enough to move turns, to undo them and to bring new ones about: kinks are found in their order,
/// each on the path the earlier ones leave. A path that changes its direction twice is not
/// followed: such a step must be cut.
class SectionKinks {
 public:
  explicit SectionKinks(SectionInfluence& influence) : influence_(influence) {}

  /// Collects the sections of a step of this length, begun at the last commit, that may have left
  /// their pieces. Returns whether there are any. Needs curvatures and rates.
  bool suspect(const SectionField& sections, const SectionMotion& start, const SectionMotion& end,
               double length);
  /// Part of the step after which it must be cut, because a suspect changed direction twice.
  std::optional<double> cut() const { return cut_; }
  /// The kinks of the suspects, and of sections they disturb, in the step from t0 to t1. Needs the
  /// whole motion.
  void find(const SectionField& sections, const SectionMotion& start, const SectionMotion& end,
            double t0, double t1);
  void clear() { kinks_.clear(); }
  /// How much the kinks found matter to each other, to first order, and the time (s) of the one
  /// that is disturbed most: what earlier kinks change in its amount_0, as the beam's answer to
  /// that (root mean square of velocities, m/s).
  struct Interplay {
    double velocity = 0.0, time = 0.0;
  };
  const Interplay& interplay() const { return interplay_; }
  const std::vector<SectionKink>& kinks() const { return kinks_; }

 private:
  // A suspect's path, as if nothing disturbed it, and what it says: all times in parts of the step.
  struct Trace {
    std::size_t section;
    const SectionBranch* branch;  // on which it flowed, if it did
    double sense;
    HermiteSeptic path;
    double left;                 // when it left its piece
    std::optional<double> turn;  // when it turned
  };
  HermiteSeptic path_of(std::size_t section, const SectionMotion& start,
                        const SectionMotion& end) const;
  void trace(const SectionField& sections, const SectionMotion& start, const SectionMotion& end);
  void add_kink(const SectionField& sections, const Trace& trace);
  // A curvature's change by what other sections did, and the rate of change in parts of the step.
  struct Change {
    double value = 0.0, slope = 0.0;
  };
  Change change_by_kinks(double s) const;
  // What earlier kinks do to one section: chosen for it before change_by_kinks is asked.
  struct Disturbance {
    double left;      // part of the step after which it acts
    double strength;  // of what it does by the step's end
    Growth growth;
  };
  void choose_disturbances(std::size_t section);

  SectionInfluence& influence_;
  double t0_ = 0.0, length_ = 0.0;
  std::vector<std::size_t> suspects_;
  std::optional<double> cut_;
  std::vector<Trace> traces_;
  std::vector<Disturbance> disturbances_;
  Interplay interplay_;
  std::vector<SectionKink> kinks_;
  SectionHistory turned_;
};

}  // namespace subimpact
