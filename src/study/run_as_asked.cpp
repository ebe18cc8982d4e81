#include "subimpact/study/run_as_asked.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "case/meshes.h"
#include "study/judgement/mesh_resolution.h"
#include "study/judgement/totals.h"
#include "subimpact/study/judgement/judgement.h"
#include "subimpact/study/model/model_errors.h"

namespace subimpact {
namespace {

// The runs beside an earlier run, from where these stood; none if it had none.
std::vector<CaseBeside> cases_that_go_on(const Case& input) {
  const auto& states = input.parts.start->beside;
  for (const auto make :
       {cases_beside, cases_beside_on_given_mesh, cases_beside_in_time, cases_beside_by_part}) {
    Case first = input;
    first.parts.start.reset();
    std::vector<CaseBeside> cases = make(first);
    const auto is_of = [](const CaseBeside& beside, const auto& state) {
      return beside.description == state.first;
    };
    if (cases.empty() || !std::ranges::equal(cases, states, is_of)) continue;
    for (std::size_t k = 0; k < cases.size(); ++k) cases[k].input.parts.start = states[k].second;
    return cases;
  }
  return {};
}

std::vector<CaseBeside> cases_asked_for(const Case& input, const RunRequest& request) {
  if (input.parts.start && request.error_bars != ErrorBars::off) return cases_that_go_on(input);
  if (!request.error_bars) return cases_beside_on_given_mesh(input);
  if (request.error_bars == ErrorBars::off) return {};
  if (request.error_bars == ErrorBars::all) return cases_beside_by_part(input);
  return cases_beside_in_time(input);
}

Result simulate_as_given(const Case& input, RunRequest& request) {
  RowSink* rows = request.rows ? request.rows() : nullptr;
  if (request.error_bars == ErrorBars::off && request.resolved) {
    return simulate(std::move(*request.resolved), request.progress, nullptr, rows);
  }
  resolve(input);  // whatever is wrong with the case itself
  Result run;
  std::vector<RunBeside> beside;
  maker_of(request)(input, cases_asked_for(input, request), rows, run, beside);
  return run;
}

WithinRun run_once(const Case& input, const GivenKeys& given, RunRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  const std::optional<OpenChoices> open = choices_left(input, given, request.error_bars);
  WithinRun run = open ? simulate_within(input, *open, request)
                       : WithinRun{input, simulate_as_given(input, request)};
  const bool is_interrupted = run.result.outcome.kind == OutcomeKind::stopped;
  const bool is_first = !input.parts.start;
  if (!is_first && request.error_bars != ErrorBars::off && !run.result.error_estimate) {
    run.result.warnings.push_back(
        "errors are not known: the earlier run had no runs beside it that could be continued too");
  }
  const bool has_errors = request.error_bars != ErrorBars::off && !is_interrupted && is_first;
  if (has_errors && request.model_errors) {
    run.result.model_errors = model_errors(run.input, run.result, request.progress);
  }
  run.result.work.all_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

StrikeRow row_of(int strike, const WithinRun& run) {
  const Result& result = run.result;
  const Energies& end = result.final_energies;
  StrikeRow row;
  row.strike = strike;
  row.sub_impacts = result.sub_impacts.size();
  row.restitution = result.restitution;
  row.striker_velocity = result.striker_velocity;
  row.peak_force = result.max_force;
  row.impulse = result.impulse();
  row.dent = result.sub_impacts.back().residual_indentation;
  row.permanent_set = largest_magnitude(result.envelope, &EnvelopeRow::set_from_supports);
  row.hinge_rotation = largest_magnitude(result.plastic_zones, &PlasticZone::rotation);
  row.striker_energy = end.striker;
  row.vibration = end.beam_kinetic + end.bending_elastic;
  row.bending_dissipated = end.bending_plastic + end.beam_damping;
  row.contact_dissipated = end.contact_plastic;
  if (!result.error_estimate) return row;
  for (const auto& [name, total] : result.error_estimate->totals) {
    if (name == RunTotal::restitution) row.restitution_error = total.error;
    if (name == RunTotal::peak_force) row.peak_force_error = total.error;
    if (name == RunTotal::permanent_set) row.permanent_set_error = total.error;
  }
  return row;
}

WithinRun strike_repeatedly(Case next, const GivenKeys& given, RunRequest& request) {
  const int n = std::exchange(next.strikes, 1);
  NoRows none;
  const auto rows = std::exchange(request.rows, [&none] { return &none; });
  request.resolved.reset();
  std::vector<StrikeRow> strikes;
  std::optional<WithinRun> run;
  for (int k = 1; k <= n; ++k) {
    if (k == n) request.rows = rows;
    if (next.parts.start && !next.at_rest) next.at_rest = true;
    if (request.announce) request.announce(fmt::format("strike {} of {}", k, n));
    try {
      run = run_once(next, given, request);
    } catch (const InvalidCase& error) {
      if (!run) throw;
      run->result.outcome.kind = OutcomeKind::left_validity;
      run->result.outcome.message = fmt::format("strike {}: {} {}", k, error.key, error.what());
      break;
    }
    if (!run->result.outcome.completed()) break;
    strikes.push_back(row_of(k, *run));
    next = run->input;
    next.parts.start = run->result.end_state;
  }
  run->result.strikes = std::move(strikes);
  run->input.strikes = n;
  return std::move(*run);
}

}  // namespace

std::optional<OpenChoices> choices_left(const Case& input, const GivenKeys& given,
                                        const std::optional<ErrorBars>& error_bars) {
  const OpenChoices open = open_choices(given);
  if (input.parts.start) {
    if (!input.accuracy.event_times) return std::nullopt;
    throw InvalidCase("accuracy.event_times",
                      "is given, but a run that goes on from another one stays on its mesh; leave "
                      "it out");
  }
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
  if (input.strikes > 1) return strike_repeatedly(input, given, request);
  return run_once(input, given, request);
}

ChosenModel first_run(const Case& input, const GivenKeys& given) {
  const std::optional<OpenChoices> open = choices_left(input, given, std::nullopt);
  return open ? first_choice(input, *open) : ChosenModel{input, {}};
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
