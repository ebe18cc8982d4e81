#include "subimpact/study/judgement/event_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "case/counted.h"
#include "case/problem.h"
#include "numerics/estimates.h"
#include "study/method_choice.h"

namespace subimpact {
namespace {

constexpr double reference_tolerance = 1e-12;

Case accurate(Case input, const std::string& method, double rtol) {
  input.solver = {};
  input.study = {};
  input.solver.rtol = rtol;
  return with_method(input, method);
}

// Two methods of different kinds that can integrate the equations of a case.
std::pair<std::string, std::string> methods_of_reference(const Case& input) {
  const auto is_possible = [&](Method method) { return possible_method(input, method) == method; };
  if (is_possible(Method::nystrom)) return {"nystrom", "erk"};
  const bool in_modes = !may_yield(input) && is_possible(Method::exponential);
  return {"erk", in_modes ? "exponential" : "erk:fehlberg-78"};
}

void require_completed(const Result& result, const std::string& method, double rtol) {
  if (result.outcome.completed() || result.outcome.kind == OutcomeKind::stopped) return;
  throw InvalidCase(
      "time.end",
      fmt::format("lies beyond what the reference run ({} at rtol {:.0e}) reaches: at {:.6g} us {}",
                  method, rtol, 1e6 * result.outcome.time, result.outcome.message));
}

// How many leading sub-impacts are known well enough, and why not more; an empty reason means all.
std::pair<std::size_t, std::string> count_known(const Result& result, double largest_error) {
  const std::size_t n = result.sub_impacts.size();
  for (std::size_t i = 0; i < n; ++i) {
    const SubImpact& s = result.sub_impacts[i];
    if (!s.certain.value_or(false)) {
      return {i, fmt::format("the reference does not resolve sub-impact {}", i + 1)};
    }
    if (!s.end) return {i, fmt::format("sub-impact {} has not ended at the case's end", i + 1)};
    const double error = std::max(s.start_error.value_or(HUGE_VAL), s.end_error.value_or(HUGE_VAL));
    if (error > largest_error) {
      return {i, fmt::format("the reference gives sub-impact {} only to within {:.1e} us", i + 1,
                             1e6 * error)};
    }
  }
  return {n, {}};
}

// Limits a reference to its first `n` sub-impacts and the separation that follows. `reason`, in
// words, is used where there are more.
void set_horizon(Reference& reference, std::size_t n, const std::string& reason) {
  const auto& all = reference.result.sub_impacts;
  reference.sub_impacts.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n));
  reference.horizon = reference.input.end_time;
  reference.horizon_reason = "the case's end";
  if (n == all.size() || n == 0) return;
  reference.horizon = 0.5 * (all[n - 1].end.value() + all[n].start);
  reference.horizon_reason = reason;
}

// Nothing if all correspond.
std::optional<UnmatchedSubImpact> first_unmatched(const std::vector<MatchedPair>& pairs,
                                                  const std::vector<SubImpact>& reference,
                                                  const std::vector<SubImpact>& run) {
  const std::size_t n = n_leading_matches(pairs);
  if (n == pairs.size()) return std::nullopt;
  const MatchedPair& unmatched = pairs[n];
  const SubImpact& sub_impact =
      unmatched.first ? reference[*unmatched.first] : run[*unmatched.second];
  const double duration = sub_impact.end.value_or(sub_impact.start) - sub_impact.start;
  return UnmatchedSubImpact{
      sub_impact.start, duration,
      fmt::format("at {:.3f} us {} a sub-impact of {:.3f} us that {}", 1e6 * sub_impact.start,
                  unmatched.first ? "the reference has" : "it has", 1e6 * duration,
                  unmatched.first ? "is missing or merged here" : "the reference does not have")};
}

std::string leading_words(std::size_t n_corresponding) {
  if (n_corresponding == 0) return "not even the first corresponds";
  if (n_corresponding == 1) return "the first corresponds";
  return fmt::format("the first {} correspond", n_corresponding);
}

// Whether two runs of a scene have the same method and the same settings of that method.
bool are_same_methods(const Result& one, const Result& other) {
  const ResolvedSettings &a = one.used, &b = other.used;
  return one.given.solver.method == other.given.solver.method && a.table == b.table &&
         a.step == b.step && a.events == b.events && a.reversals == b.reversals &&
         a.max_order == b.max_order && a.position_tolerance == b.position_tolerance;
}

}  // namespace

Reference run_reference(const Case& input, double rtol, const Progress& progress, Jobs jobs) {
  const auto [first, second] = methods_of_reference(input);
  Reference reference;
  reference.input = accurate(input, first, rtol);
  reference.description =
      fmt::format("{} at rtol {:.0e} and {} at rtol {:.0e}", first, rtol, second, rtol);
  reference.horizon = input.end_time;
  Result& result = reference.result;
  std::vector<RunBeside> beside = simulate_beside(
      reference.input, {{accurate(input, second, rtol), ErrorSource::time, reference.description}},
      jobs, progress, nullptr, result);
  require_completed(result, first, rtol);
  for (const RunBeside& other : beside) require_completed(other.result, second, rtol);
  if (beside.empty() || result.outcome.kind == OutcomeKind::stopped) return reference;
  judge(reference.input, result, beside);
  reference.sub_impacts = result.sub_impacts;
  reference.error = result.error_estimate->largest_error;
  reference.other = std::move(beside.front().result);
  return reference;
}

Reference compute_reference(const Case& input, double largest_error, const Progress& progress,
                            Jobs jobs) {
  Reference reference = run_reference(input, reference_tolerance, progress, jobs);
  if (reference.result.outcome.kind == OutcomeKind::stopped) return reference;
  const auto [n, reason] = count_known(reference.result, largest_error);
  if (n == 0) {
    throw InvalidCase(
        "time.end", fmt::format("is {} s, but no sub-impact that ends before it counts ({}); use a "
                                "later end",
                                input.end_time, reason.empty() ? "there is none" : reason));
  }
  set_horizon(reference, n, reason);
  reference.error = 0.0;
  for (const SubImpact& s : reference.sub_impacts) {
    reference.error = std::max({reference.error, *s.start_error, *s.end_error});
  }
  if (reference.horizon < input.end_time) {
    const std::string second = methods_of_reference(input).second;
    reference.input.end_time = reference.horizon;
    reference.result = simulate(reference.input, progress);
    reference.other = simulate(accurate(reference.input, second, reference_tolerance), progress);
  }
  return reference;
}

EventErrors event_errors(const std::vector<SubImpact>& run,
                         const std::vector<SubImpact>& reference) {
  EventErrors errors;
  errors.n_reference = reference.size();
  errors.n_found = run.size();
  const std::vector<MatchedPair> pairs = match_sub_impacts(reference, run);
  errors.n_corresponding = n_leading_matches(pairs);
  errors.unmatched = first_unmatched(pairs, reference, run);
  double largest_impulse = 0.0;
  for (const SubImpact& s : reference) largest_impulse = std::max(largest_impulse, s.impulse);
  std::vector<double> times;
  for (std::size_t i = 0; i < errors.n_corresponding; ++i) {
    const SubImpact& there = reference[i];
    const SubImpact& here = run[i];
    if (there.end && !here.end) {
      errors.n_corresponding = i;
      errors.unmatched = {here.start, *there.end - there.start,
                          fmt::format("at {:.3f} us the contact of the reference ends, and it is "
                                      "still open here",
                                      1e6 * *there.end)};
      break;
    }
    const double start = std::abs(here.start - there.start);
    errors.starts = std::max(errors.starts, start);
    if (i > 0) times.push_back(start);
    if (here.end && there.end) {
      times.push_back(std::abs(*here.end - *there.end));
      errors.ends = std::max(errors.ends, times.back());
    }
    errors.peak_force =
        std::max(errors.peak_force, std::abs(here.peak_force / there.peak_force - 1.0));
    errors.impulse =
        std::max(errors.impulse, std::abs(here.impulse - there.impulse) / largest_impulse);
  }
  errors.n_times = times.size();
  if (!times.empty()) {
    errors.maximum = *std::max_element(times.begin(), times.end());
    errors.rms = std::sqrt(std::inner_product(times.begin(), times.end(), times.begin(), 0.0) /
                           static_cast<double>(times.size()));
    errors.first = times.front();
    errors.last = times.back();
  }
  errors.median = median(std::move(times));
  return errors;
}

EventErrors event_errors(const Result& run, const Reference& reference) {
  const bool is_own = are_same_methods(run, reference.result);
  const Result& there = is_own ? reference.other : reference.result;
  EventErrors errors =
      event_errors(run.sub_impacts, is_own ? there.sub_impacts : reference.sub_impacts);
  const double unit = reference.input.scene.bodies().velocity_scale();
  errors.striker_velocity = std::abs(run.striker_velocity - there.striker_velocity) / unit;
  errors.beam_velocity = std::abs(run.beam_mean_velocity - there.beam_mean_velocity) / unit;
  return errors;
}

std::string_view to_string(Verdict verdict) {
  constexpr std::string_view names[] = {"right",  "wrong count", "inaccurate", "unstable",
                                        "failed", "refused",     "not run"};
  return names[static_cast<std::size_t>(verdict)];
}

Verdict judge(const Result& run, const EventErrors& errors) {
  using enum OutcomeKind;
  const OutcomeKind kind = run.outcome.kind;
  if (kind == completed) return errors.all_correspond() ? Verdict::right : Verdict::wrong_count;
  if (kind == inaccurate || kind == chattering) return Verdict::inaccurate;
  // The reference of the scene stays within the validity.
  if (kind == unstable || kind == left_validity) return Verdict::unstable;
  return Verdict::failed;
}

Result run_trial(Trial& trial, const Reference& reference, const Progress& progress) {
  try {
    Result result = simulate(trial.input, progress);
    trial.work = result.work;
    trial.seconds = result.work.wall_seconds;
    trial.repeats = 1;
    trial.energy_error = result.max_energy_error;
    trial.errors = event_errors(result, reference);
    trial.verdict = judge(result, trial.errors);
    const EventErrors& errors = trial.errors;
    if (!result.outcome.completed()) {
      trial.message =
          fmt::format("at {:.6g} us {}", 1e6 * result.outcome.time, result.outcome.message);
    } else if (errors.unmatched) {
      const std::string within =
          errors.n_times > 0 ? fmt::format(" within {:.3g} us", 1e6 * errors.maximum) : "";
      trial.message = fmt::format(
          "{} instead of {}; {}{}; {}", counted(errors.n_found, "sub-impact"), errors.n_reference,
          leading_words(errors.n_corresponding), within, errors.unmatched->description);
    } else if (are_same_methods(result, reference.result)) {
      trial.message = "the reference's own run, beside its other one";
    }
    return result;
  } catch (const InvalidCase& error) {
    trial.verdict = Verdict::refused;
    trial.message = error.what();
    return {};
  }
}

}  // namespace subimpact
