#pragma once

#include <optional>

#include "subimpact/case/case.h"
#include "subimpact/simulate/simulate.h"

namespace subimpact {

/// The parts that a case stands for: mesh, contact law, section. Throws InvalidCase where mesh and
/// scene do not go together.
Problem problem_of(const Case& input);

/// Checks a case and makes the parts of its run: resolve(case).settings() is what would be
/// modelled, and simulate(resolve(case)) is simulate(case). Throws InvalidCase.
ResolvedRun resolve(const Case& input);

/// Runs a case. Throws InvalidCase; any other failure is reported in the outcome. Thread-safe (see
/// simulate(ResolvedRun)).
Result simulate(const Case& input, const Progress& progress = {}, Observer* observer = nullptr,
                RowSink* rows = nullptr);
/// The same, with an observer alone.
inline Result simulate(const Case& input, Observer& observer) {
  return simulate(input, {}, &observer);
}

/// What a run will roughly take.
struct CostEstimate {
  double steps = 0.0;
  double right_hand_sides = 0.0;
  double seconds_per_right_hand_side = 0.0;  ///< measured on this machine, on the beam at rest
  double seconds = 0.0;
};

/// Steps follow from the fixed step or, for adaptive methods, from the highest frequency of the
/// mesh, table and tolerance, by a fit to the paper's example, and from the damping of the highest
/// mode. Time follows from right-hand sides timed on the spot for some milliseconds. How much the
/// beam will yield is unknown beforehand, so the true cost may be three times less or more. Nothing
/// for a method without such a fit, and for a rigid beam. Evaluates the equations of motion of
/// `run`, which shows in the counts of its result.
std::optional<CostEstimate> estimate_cost(ResolvedRun& run);

}  // namespace subimpact
