#include "study/timed_run.h"

#include <algorithm>

namespace subimpact {

TimedRun timed_run(const Case& input, double budget, int most_repeats, const Progress& progress) {
  TimedRun run;
  run.result = simulate(input, progress);
  run.seconds = run.result.work.wall_seconds;
  run.repeats = 1;
  if (!run.result.outcome.completed()) return run;
  double total = run.seconds;
  for (int i = 0; i < most_repeats && total < budget; ++i) {
    const Result again = simulate(input, progress);
    if (again.outcome.kind == OutcomeKind::stopped) {
      run.result.outcome = again.outcome;  // a timing cut short is none
      return run;
    }
    const double seconds = again.work.wall_seconds;
    total += seconds;
    run.seconds = i == 0 ? seconds : std::min(run.seconds, seconds);
    run.repeats = i + 1;
  }
  return run;
}

}  // namespace subimpact
