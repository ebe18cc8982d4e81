#pragma once

#include "subimpact/case/simulate.h"

namespace subimpact {

/// Runs a case and a refined run, which integrates more accurately (rtol a hundred times smaller,
/// or half the fixed step), and gives every sub-impact's start and end an estimated error: three
/// times the largest difference between the two runs over the event and its neighbours, so that a
/// difference that happens to pass through zero is not taken for accuracy, plus the rounding of the
/// times themselves. It covers the integration in time alone, not mesh or model.
///
/// From the first sub-impact on that the refined run does not have, or whose error reaches a
/// quarter of its duration or of a separation beside it, neither count nor order is certain:
/// Result::error_estimate names it. Where rtol leaves no room for a smaller one (below 1e-12) the
/// refined run integrates less accurately instead, and its errors are stated. `rows`, if any, takes
/// the rows of the case's own run. Throws InvalidCase.
Result simulate_with_error_bars(const Case& input, const Progress& progress = {},
                                RowSink* rows = nullptr);

/// The refined run's case, and in words what it changes.
struct RefinedRun {
  Case input;
  std::string description;
};
RefinedRun refined_run_of(const Case& input);

/// Fills the errors and the error estimate of `result` from the sub-impacts of a refined run.
void add_error_bars(Result& result, const Result& refined_run, const std::string& description);

}  // namespace subimpact
