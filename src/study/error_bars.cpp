#include "subimpact/study/error_bars.h"

#include <fmt/format.h>

#include <cmath>

#include "study/error_part.h"

namespace subimpact {
namespace {

constexpr double tighter = 1e-2;
constexpr double tightest = 1e-14;
constexpr double safety = 3.0;

}  // namespace

Companion companion_of(const Case& input) {
  Companion companion{input, {}};
  companion.input.output.keep_no_rows();
  SolverOptions& solver = companion.input.solver;
  if (const std::optional<double> step = resolve(input).settings().step) {
    solver.step = 0.5 * *step;
    companion.description =
        fmt::format("the same with half the step, {:.6g} us", 1e6 * *solver.step);
  } else if (tighter * solver.rtol >= tightest) {
    solver.rtol *= tighter;
    companion.description = fmt::format("the same with rtol = {:.3g}", solver.rtol);
  } else {
    solver.rtol /= tighter;
    companion.description =
        fmt::format("the same with rtol = {:.3g}, whose errors these are", solver.rtol);
  }
  return companion;
}

void add_error_bars(Result& result, const Result& companion, const std::string& description) {
  set_error_bars(result, {compare_events(result, companion, "time", description, safety)});
}

Result simulate_with_error_bars(const Case& input, const Progress& progress) {
  // Each run shows half of the progress.
  const auto half = [&](double offset) -> Progress {
    if (!progress) return {};
    return [&progress, offset, end = input.end_time](double t) {
      return progress(0.5 * (offset * end + t));
    };
  };
  Result result = simulate(input, half(0.0));
  if (result.outcome.kind == OutcomeKind::stopped) return result;
  const Companion companion = companion_of(input);
  const Result second = simulate(companion.input, half(1.0));
  add_error_bars(result, second, companion.description);
  return result;
}

}  // namespace subimpact
