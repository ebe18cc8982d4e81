#pragma once

#include <string>
#include <vector>

#include "subimpact/case/simulate.h"

namespace subimpact {

/// The event times of a case's semi-discrete equations, as accurate as the program can compute
/// them: errors of the time integration are measured against these.
struct Reference {
  Case input;                          ///< of the run; ends at the horizon
  Result result;                       ///< up to the horizon
  std::vector<SubImpact> sub_impacts;  ///< those that count, with their stated errors
  double error = 0.0;                  ///< s, the largest error stated for them
  double horizon = 0.0;                ///< s, up to which runs are compared
  std::string horizon_reason;          ///< in words
  std::string description;             ///< the two runs, in words
};

/// Two runs by different methods, one beside the other on two cores: `exponential` and `nystrom` at
/// rtol = 1e-12 where the beam is elastic, else `nystrom` and `erk`. The error stated for an event
/// is three times the largest difference of the two over it and its neighbours (add_error_bars).
///
/// A sub-impact counts if both runs have it and its stated error is at most `largest_error` (s):
/// sub-impacts that graze amplify small differences until no computation can predict the next
/// event. The horizon lies in the middle of the separation after the last that counts, or at the
/// case's end if that is separation too. Throws InvalidCase if nothing counts, if either run fails,
/// or for the case itself.
Reference compute_reference(const Case& input, double largest_error, const Progress& progress = {});

}  // namespace subimpact
