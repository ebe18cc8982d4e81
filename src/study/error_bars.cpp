#include "subimpact/study/error_bars.h"

#include <fmt/format.h>

#include "case/problem.h"
#include "study/error_part.h"

namespace subimpact {
namespace {

constexpr double tighter = 1e-2;
constexpr double tightest = 1e-14;
constexpr double safety = 3.0;

}  // namespace

RefinedRun refined_run_of(const Case& input) {
  RefinedRun refined_run{input, {}};
  refined_run.input.output.keep_no_rows();
  SolverOptions& solver = refined_run.input.solver;
  if (const std::optional<double> step = step_of(input)) {
    solver.step = 0.5 * *step;
    refined_run.description =
        fmt::format("the same with half the step, {:.6g} us", 1e6 * *solver.step);
  } else if (tighter * solver.rtol >= tightest) {
    solver.rtol *= tighter;
    refined_run.description = fmt::format("the same with rtol = {:.3g}", solver.rtol);
  } else {
    solver.rtol /= tighter;
    refined_run.description =
        fmt::format("the same with rtol = {:.3g}, whose errors these are", solver.rtol);
  }
  return refined_run;
}

void add_error_bars(Result& result, const Result& refined_run, const std::string& description) {
  set_error_bars(result, {compare_events(result, refined_run, "time", description, safety)});
}

Result simulate_with_error_bars(const Case& input, const Progress& progress, RowSink* rows) {
  // Each run shows half of the progress.
  const auto half = [&](double offset) -> Progress {
    if (!progress) return {};
    return [&progress, offset, end = input.end_time](double t) {
      return progress(0.5 * (offset * end + t));
    };
  };
  Result result = simulate(input, half(0.0), nullptr, rows);
  if (result.outcome.kind == OutcomeKind::stopped) return result;
  const RefinedRun refined_run = refined_run_of(input);
  const Result second = simulate(refined_run.input, half(1.0));
  add_error_bars(result, second, refined_run.description);
  return result;
}

}  // namespace subimpact
