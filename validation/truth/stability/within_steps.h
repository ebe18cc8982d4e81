#pragma once

/// Runs of a case: sub-impacts within one step, and layers against the exact section.

#include <vector>

#include "subimpact/study/judgement/event_errors.h"

namespace subimpact {

/// Sub-impacts and separations that begin and end within one step: of runs at several striking
/// speeds (from half to one and a half times the case's; elastic beam, exponential method), how
/// many have all sub-impacts up to the horizon, with and without the search for such pairs.
struct MissedPairs {
  double step = 0.0;  ///< s
  int n_runs = 0;
  int right_with_search = 0;
  int right_without = 0;
  double shortest = 0.0;  ///< s, the shortest sub-impact or separation of all references
};
std::vector<MissedPairs> missed_pairs(const Case& input);

/// Layers compared with the exact law, their limit, integrated as accurately as the reference.
struct LayerPoint {
  int layers = 0;
  EventErrors errors;  ///< against the exact law
};
struct LayerStudy {
  Reference exact;
  std::vector<LayerPoint> points;
};
LayerStudy layers_against_exact(const Case& input);

}  // namespace subimpact
