#include "subimpact/study/run_as_asked.h"

#include <utility>

#include "subimpact/study/error_bars.h"
#include "subimpact/study/mesh_error_bars.h"

namespace subimpact {
namespace {

Result simulate_as_given(const Case& input, RunRequest& request) {
  RowSink* rows = request.rows ? request.rows() : nullptr;
  if (!request.error_bars)
    return simulate_with_companion(input, request.jobs, request.progress, rows);
  switch (*request.error_bars) {
    case ErrorBars::time:
      return simulate_with_error_bars(input, request.progress, rows);
    case ErrorBars::all:
      return simulate_with_all_error_bars(input, request.progress, rows);
    case ErrorBars::off:
      break;
  }
  if (!request.resolved) return simulate(input, request.progress, nullptr, rows);
  return simulate(std::move(*request.resolved), request.progress, nullptr, rows);
}

}  // namespace

std::optional<OpenChoices> choices_left(const Case& input, const GivenKeys& given,
                                        const std::optional<ErrorBars>& error_bars) {
  const OpenChoices open = open_choices(given);
  if (input.accuracy.event_times) {
    if (!error_bars) return open;
    throw InvalidCase("accuracy.event_times",
                      "cannot go with error bars of another kind: the errors of a wish for event "
                      "times come from companion runs; leave out one of the two");
  }
  if (open.all() && !error_bars) return open;
  return std::nullopt;
}

WithinRun run_as_asked(const Case& input, const GivenKeys& given, RunRequest request) {
  const std::optional<OpenChoices> open = choices_left(input, given, request.error_bars);
  WithinRun run = open ? simulate_within(input, *open, request)
                       : WithinRun{input, simulate_as_given(input, request)};
  const bool is_interrupted = run.result.outcome.kind == OutcomeKind::stopped;
  if (request.error_bars != ErrorBars::off && !is_interrupted) {
    run.result.neglected_shear = neglected_shear(run.input, run.result);
  }
  return run;
}

Case case_as_chosen(const Case& input, const GivenKeys& given, Jobs jobs,
                    const Progress& progress) {
  const std::optional<OpenChoices> open = choices_left(input, given, std::nullopt);
  if (!open) return input;
  WithinOptions how;
  how.jobs = jobs;
  how.progress = progress;
  Case without_rows = input;
  without_rows.output.keep_no_rows();
  return simulate_within(without_rows, *open, how).input;
}

}  // namespace subimpact
