#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "ode/integrator.h"
#include "system/section/section_events.h"

namespace subimpact {

/// The changes that the section events of a step make in the state at its end.
struct SectionCorrection {
  std::vector<SectionEvent> events;
  std::vector<double> position_change, velocity_change;  ///< m, m/s, one entry per beam unknown
  /// The end of the step, s, or an earlier time at which the step must be cut and corrected anew.
  double valid_until = 0.0;

  bool is_empty() const { return events.empty(); }
  void add_to(State& y) const;
  /// The sections with those that reversed in the step as they are after it.
  SectionField reversed(const SectionField& sections) const;
};

/// Defect correction of a step for section events: sections that leave, within the step, the smooth
/// pieces of their laws (docs/theory/events.md, "Section events"). The first terms come without
/// mass solves (SectionInfluence); each further pair costs two. The beam is not changed.
class SectionCorrector {
 public:
  /// `beam` must outlive this. `tolerance`: how far velocities at the step's end may be off by the
  /// correction (root mean square, m/s).
  SectionCorrector(const StruckBeam& beam, double tolerance);

  /// The correction at the end of a step that began at the last committed state.
  void correct(const StepEnds& step, SectionCorrection& correction);

  /// Mass solves so far, for terms of the expansion beyond the first.
  long n_mass_solves() const { return n_mass_solves_; }

 private:
  // The end of a step that is to be cut at a time: no sooner than the shortest step.
  double cut_at(double time, const StepEnds& step) const {
    return std::min(std::max(time, step.t0 + shortest_step_), step.t1);
  }
  void read_loads(double t, const State& y, const SectionMotion& motion, SectionLoads& loads);
  void read_response(const StepEnds& step, SectionCorrection& correction);
  // Tangents of the smooth pieces, taken at the step's end, times changes of curvature.
  void linear_moments(std::span<const double> changes, std::span<const double> curvatures,
                      std::span<double> moments) const;
  // Sum of A^k a_(2k + order), k = 0..last.
  void sum_terms(const std::vector<SectionEvent>& events, std::size_t order, std::size_t last,
                 std::vector<double>& sum);
  // A bound of the k-th term's contribution to velocities, root mean square, m/s.
  double bound_of_term(const std::vector<SectionEvent>& events, std::size_t k);

  const StruckBeam& beam_;
  double tolerance_;
  double shortest_step_;  // that a cut may leave, s
  SectionInfluence influence_;
  SectionEvents finder_;
  SectionMotion end_;
  SectionLoads start_loads_, end_loads_;
  std::vector<double> curvatures_, moments_, forces_;
  long n_mass_solves_ = 0;
};

class FirstFlow {
 public:
  explicit FirstFlow(std::size_t n_sections) : start_(n_sections), end_(n_sections) {}
  /// If a section flows at the end of a step that began at the last committed state: the time (s)
  /// at which the first of them left its window.
  std::optional<double> find(const StruckBeam& beam, const StepEnds& step);

 private:
  SectionMotion start_, end_;
};

}  // namespace subimpact
