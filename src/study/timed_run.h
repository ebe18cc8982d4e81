#pragma once

#include "subimpact/case/simulate.h"

namespace subimpact {

/// A run and how long it takes.
struct TimedRun {
  Result result;
  double seconds = 0.0;  ///< wall time, set-up included: the shortest of the repeats
  int repeats = 0;
};

/// Runs the case once to warm up (the result of that run is returned), then again until
/// `most_repeats` or a total of `budget` seconds is reached; a first run that uses up the budget
/// alone is the timed one. Nothing else should run on the machine meanwhile. Throws InvalidCase.
TimedRun timed_run(const Case& input, double budget, int most_repeats,
                   const Progress& progress = {});

}  // namespace subimpact
