#pragma once

#include <optional>

#include "subimpact/case/case.h"
#include "subimpact/simulate/simulate.h"

namespace subimpact {

/// The parts that a case describes: mesh, contact law, section. Throws InvalidCase if mesh and
/// scene do not fit each other.
Problem problem_of(const Case& input);

/// Checks a case and makes the parts of its run: resolve(case).settings() are the settings of that
/// run, and simulate(resolve(case)) is simulate(case). Throws InvalidCase.
ResolvedRun resolve(const Case& input);

/// Runs a case. Throws InvalidCase; any other failure is reported in the outcome. Thread-safe (see
/// simulate(ResolvedRun)).
Result simulate(const Case& input, const Progress& progress = {}, Observer* observer = nullptr,
                RowSink* rows = nullptr);
/// simulate() with an observer only.
inline Result simulate(const Case& input, Observer& observer) {
  return simulate(input, {}, &observer);
}

/// Rough estimate of the cost of a run.
struct CostEstimate {
  double steps = 0.0;
  double right_hand_sides = 0.0;
  double seconds_per_right_hand_side = 0.0;  ///< measured on this machine, on the beam at rest
  double seconds = 0.0;
};

/// Steps follow from the fixed step or, for adaptive methods, from the highest frequency of the
/// mesh, table and tolerance, by a fit to the paper's example, and from the damping of the highest
/// mode. Time follows from right-hand sides timed on the spot for a few milliseconds. How much the
/// beam will yield is unknown beforehand, so the true cost may differ by a factor of three. Returns
/// nothing for a method without such a fit, and for a rigid beam. The timing evaluates the
/// equations of motion of `run`, which adds to the counts of its result.
std::optional<CostEstimate> estimate_cost(ResolvedRun& run);

}  // namespace subimpact
