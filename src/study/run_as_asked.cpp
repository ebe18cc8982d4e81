#include "subimpact/study/run_as_asked.h"

#include <fmt/format.h>

#include <chrono>

#include "case/meshes.h"
#include "study/judgement/totals.h"
#include "subimpact/study/answers.h"
#include "subimpact/study/model.h"

namespace subimpact {
namespace {

std::vector<CaseBeside> cases_asked_for(const Case& input, const RunRequest& request) {
  if (!request.error_bars) return cases_beside_on_given_mesh(input);
  if (request.error_bars == ErrorBars::off) return {};
  return cases_beside(input);
}

// `beside`: the cases that judge the run, if they are known.
WithinRun run_as_given(const Case& input, const RunRequest& request,
                       const std::vector<CaseBeside>* beside) {
  WithinRun run{input, {}, {}};
  resolve(input);  // whatever is wrong with the case itself
  maker_of(request)(input, beside != nullptr ? *beside : cases_asked_for(input, request),
                    request.rows ? request.rows() : nullptr, run.result, run.beside);
  return run;
}

WithinRun run_once(const Case& input, const GivenKeys& given, const RunRequest& request,
                   const std::vector<CaseBeside>* beside = nullptr) {
  const auto start = std::chrono::steady_clock::now();
  const std::optional<OpenChoices> open = choices_left(input, given, request.error_bars);
  WithinRun run =
      open ? simulate_within(input, *open, request) : run_as_given(input, request, beside);
  const bool is_interrupted = run.result.outcome.kind == OutcomeKind::stopped;
  const bool has_errors = request.error_bars != ErrorBars::off && !is_interrupted;
  if (has_errors && request.body_errors) {
    add_body_errors(run.input, run.result, request.progress);
  }
  run.result.work.all_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

// The cases beside a strike for the next one; none unless each of them has an end.
std::vector<CaseBeside> cases_of_next_strike(std::vector<RunBeside> beside) {
  std::vector<CaseBeside> cases;
  for (RunBeside& other : beside) {
    if (!other.result.end_state) return {};
    cases.push_back(std::move(other.of));
    cases.back().input.parts.start = std::move(other.result.end_state);
  }
  return cases;
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
  row.restitution_error = error_of_total(result, RunTotal::restitution);
  row.peak_force_error = error_of_total(result, RunTotal::peak_force);
  row.permanent_set_error = error_of_total(result, RunTotal::permanent_set);
  return row;
}

WithinRun strike_repeatedly(Case next, const GivenKeys& given, RunRequest& request) {
  const int n = std::exchange(next.strikes, 1);
  const bool has_body_errors =
      std::exchange(request.body_errors, false) && request.error_bars != ErrorBars::off;
  NoRows none;
  const auto rows = std::exchange(request.rows, [&none] { return &none; });
  std::vector<StrikeRow> strikes;
  std::optional<WithinRun> run;
  std::vector<CaseBeside> beside;
  for (int k = 1; k <= n; ++k) {
    if (k == n) request.rows = rows;
    if (request.announce) request.announce(fmt::format("strike {} of {}", k, n));
    try {
      run = run_once(next, given, request, k > 1 ? &beside : nullptr);
    } catch (const InvalidCase& error) {
      if (!run) throw;
      run->result.outcome.kind = OutcomeKind::left_validity;
      run->result.outcome.message = fmt::format("strike {}: {}", k, error.what());
      break;
    }
    if (!run->result.outcome.completed()) break;
    strikes.push_back(row_of(k, *run));
    next = run->input;
    next.parts.start = run->result.end_state;
    beside = cases_of_next_strike(std::move(run->beside));
  }
  if (has_body_errors && std::ssize(strikes) == n) {
    next.parts.start.reset();
    next.strikes = n;
    add_body_errors(next, run->result, request.progress);
  }
  run->result.strikes = std::move(strikes);
  run->input.strikes = n;
  return std::move(*run);
}

}  // namespace

std::optional<OpenChoices> choices_left(const Case& input, const GivenKeys& given,
                                        const std::optional<ErrorBars>& error_bars) {
  const OpenChoices open = open_choices(given);
  if (input.parts.start) return std::nullopt;  // on the mesh of the strike before
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
