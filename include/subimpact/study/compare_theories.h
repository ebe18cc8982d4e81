#pragma once

#include <functional>
#include <span>
#include <vector>

#include "subimpact/case/simulate.h"
#include "subimpact/study/companion.h"
#include "subimpact/study/match.h"

namespace subimpact {

/// One theory's run of a scene, with error bars of its own, beside the run of the first theory.
struct TheoryRun {
  BeamTheory theory;
  Result result;
  std::vector<MatchedPair> pairs;  ///< the first theory's (first) against this run (second)
};

/// Runs a scene by several beam theories: cases that differ in beam.theory alone. `announce` is
/// called with the index of each run that begins; `progress`, if any, can end the comparison: the
/// runs are then those that had ended. Throws InvalidCase before anything is run.
std::vector<TheoryRun> compare_theories(std::span<const Case> cases, Jobs jobs,
                                        const std::function<void(std::size_t)>& announce = {},
                                        const Progress& progress = {});

}  // namespace subimpact
