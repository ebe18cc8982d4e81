#include "subimpact/study/run_as_asked.h"

#include <utility>

#include "subimpact/study/judgement.h"

namespace subimpact {
namespace {

std::vector<CaseBeside> cases_asked_for(const Case& input, const RunRequest& request) {
  if (!request.error_bars) return cases_beside_on_given_mesh(input);
  switch (*request.error_bars) {
    case ErrorBars::time:
      return cases_beside_in_time(input);
    case ErrorBars::all:
      return cases_beside_by_part(input);
    case ErrorBars::off:
      break;
  }
  return {};
}

Result simulate_as_given(const Case& input, RunRequest& request) {
  RowSink* rows = request.rows ? request.rows() : nullptr;
  if (request.error_bars == ErrorBars::off && request.resolved) {
    return simulate(std::move(*request.resolved), request.progress, nullptr, rows);
  }
  resolve(input);  // whatever is wrong with the case itself
  return simulate_judged(input, cases_asked_for(input, request), request.jobs, request.progress,
                         rows);
}

}  // namespace

std::optional<OpenChoices> choices_left(const Case& input, const GivenKeys& given,
                                        const std::optional<ErrorBars>& error_bars) {
  const OpenChoices open = open_choices(given);
  if (input.accuracy.event_times) {
    if (!error_bars) return open;
    throw InvalidCase("accuracy.event_times",
                      "cannot go with error bars of another kind: the errors of a searched mesh "
                      "come from coarser ones; leave out one of the two");
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
