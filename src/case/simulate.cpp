#include "subimpact/case/simulate.h"

#include <chrono>

#include "case/problem.h"
#include "simulate/run_parts.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/case/doubtful_units.h"
#include "subimpact/case/validity.h"

namespace subimpact {

ResolvedRun resolve(const Case& input) {
  const auto start = std::chrono::steady_clock::now();
  check(input);
  ResolvedRun run = resolve(problem_of(input), input);
  run.parts().warnings = doubtful_units(input);
  run.parts().warnings_of_result = [input](const Result& result) {
    return beyond_the_model(input, result);
  };
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  run.parts().setup_seconds = taken.count();
  return run;
}

Result simulate(const Case& input, const Progress& progress, Observer* observer, RowSink* rows) {
  return simulate(resolve(input), progress, observer, rows);
}

}  // namespace subimpact
