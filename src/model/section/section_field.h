#pragma once

#include <optional>
#include <span>
#include <vector>

#include "model/section/section_law.h"
#include "numerics/lanes.h"

namespace subimpact {

/// The bending law of every section of a beam, with the memory of those that have yielded.
///
/// A section costs memory only once it has yielded, and the law is evaluated only for a section
/// whose curvature has left the window in which none of its fibres flows; inside it M is linear in
/// kappa. Curvatures and moments are arrays of size() entries, one per section, in 1/m and N m; M
/// has the sign of the curvature.
class SectionField {
 public:
  /// A field that never yields, M = stiffness kappa.
  SectionField(std::size_t n_sections, double stiffness);
  SectionField(std::size_t n_sections, const SectionLaw& law);

  std::size_t size() const { return low_.size(); }
  bool can_yield() const { return law_.has_value(); }
  /// Largest slope dM/dkappa of any section in any state, N m2.
  double stiffness() const { return stiffness_; }

  struct Outside {
    std::size_t section;
    double curvature;
  };
  /// M for the given curvatures, history unchanged; `outside`, if given, becomes the list of the
  /// sections outside their windows.
  void moments(std::span<const double> curvatures, std::span<double> moments,
               std::vector<Outside>* outside = nullptr) const;
  /// dM/dkappa of one section, N m2.
  double tangent(std::size_t section, double curvature) const;

  /// Moments on the smooth pieces that held at the last commit, each continued beyond its range: a
  /// section that continued to flow stays on its branch, every other one is linear. Neither has a
  /// discontinuity of slope.
  void smooth_moments(std::span<const double> curvatures, std::span<double> moments) const;
  double smooth_tangent(std::size_t section, double curvature) const;

  /// M of a section in which no fibre flows, its elastic window continued.
  double resting_moment(std::size_t section, double curvature) const {
    return stiffness_ * curvature - offset_[section];
  }

  /// Accepts the curvatures of a state that was reached. The curvature rates (1/(m s)), if given,
  /// decide which of the sections that flowed continue to flow. Returns how many flowed.
  std::size_t commit(std::span<const double> curvatures, std::span<const double> rates = {});
  /// commit() for curvatures of which moments(), since the last commit, has listed those outside.
  std::size_t commit(const std::vector<Outside>& outside);
  /// Commits the curvature at which one section reversed on the way to the next state.
  void commit_reversal(std::size_t section, double curvature);
  /// No section flows from now until the next commit.
  void stop_flow() { flowing_.clear(); }

  /// A section that continues to flow from its edge.
  struct Flow {
    std::size_t section;
    SectionBranch branch;
  };
  /// The sections that continued to flow at the last commit, in ascending order.
  const std::vector<Flow>& flowing() const { return flowing_; }
  const SectionBranch* flowing_branch(std::size_t section) const;  ///< of one, if it is among them
  /// The law (none for a field that never yields) and the history of a section.
  const SectionLaw& law() const { return *law_; }
  const SectionHistory& history(std::size_t section) const;

  /// Bounds of the windows within which nothing flows, 1/m.
  std::span<const double> window_low() const { return low_; }
  std::span<const double> window_high() const { return high_; }
  /// Whether one of these curvatures is outside the window of its section.
  bool any_outside(std::span<const double> curvatures) const;

  bool has_yielded(std::size_t section) const {
    return can_yield() && history(section).direction != 0;
  }
  std::size_t n_yielded() const { return n_yielded_; }  ///< sections in which any fibre has flowed

  /// Energies with integration weights (m) of the sections.
  BendingEnergies energies(std::span<const double> curvatures,
                           std::span<const double> weights) const;

  /// Stress of the outermost fibre away from the striker, Pa; `outer_stiffness` = E h/2 for
  /// sections that never yield.
  double outer_stress(std::size_t section, double curvature, double outer_stiffness) const;

 private:
  template <class Visit>
  void for_each_outside(std::span<const double> curvatures, Visit visit) const;
  // Energies of a yielded section without moment; while nothing flows, a moment M adds M^2/(2
  // stiffness) to the elastic one. They follow from the history alone, and are computed when first
  // needed after each flow.
  const BendingEnergies& at_rest(std::size_t section) const;

  std::optional<SectionLaw> law_;
  double stiffness_;
  AlignedVector low_, high_, offset_;  // windows
  std::vector<int> slot_;              // index into memory_, -1: never yielded
  std::vector<SectionHistory> memory_;
  mutable std::vector<std::optional<BendingEnergies>> at_rest_;  // of each history
  std::vector<Flow> flowing_;
  std::size_t n_yielded_ = 0;
};

}  // namespace subimpact
