#pragma once

#include <optional>

#include "subimpact/simulate/simulate.h"

namespace subimpact {

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
