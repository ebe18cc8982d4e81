#include "simulate/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "simulate/observers.h"
#include "simulate/recorder.h"
#include "system/no_more_contact.h"

namespace subimpact {
namespace {

constexpr long progress_interval = 512;  // steps
constexpr long proof_interval = 32;

// A contact of fewer steps is not resolved.
constexpr long fewest_steps_in_contact = 8;

constexpr double us = 1e6;  // per second

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// With a fixed step contacts may be too short for it although the accounts close.
void warn_of_short_contacts(const Recorder& recorder, double step, Result& result) {
  const auto& steps = recorder.steps_in_contact();
  const auto n_short =
      std::count_if(steps.begin(), steps.end(), [](long n) { return n < fewest_steps_in_contact; });
  if (n_short == 0) return;
  result.warnings.push_back(
      fmt::format("{} of {} contacts last fewer than {} steps of {:.4g} us, the shortest {}: their "
                  "times, forces and even their number are uncertain; use a smaller solver.step",
                  n_short, steps.size(), fewest_steps_in_contact, us * step,
                  *std::min_element(steps.begin(), steps.end())));
}

void count_work(const Integrator& integrator, const StruckBeam& beam, const EventLoop& loop,
                Work& work) {
  const WorkCounts counts = integrator.work();
  work.steps = counts.steps;
  work.rejected_steps = counts.rejected_steps;
  work.partial_steps = counts.partial_steps;
  work.right_hand_sides = beam.n_accelerations() + beam.n_forces();
  const bool in_modes = !beam.mesh().modal_stiffness().empty();  // where mass is diagonal
  work.mass_solves =
      in_modes ? 0 : beam.n_accelerations() + loop.n_correction_solves() + counts.mass_solves;
  work.jacobians = counts.jacobians;
  work.factorisations = (in_modes ? 0 : 1) + counts.factorisations;
  work.nonlinear_iterations = counts.nonlinear_iterations;
  work.nonlinear_failures = counts.nonlinear_failures;
  work.roots = loop.n_events();
}

// Steps to the end, or to where the run is stopped.
void run_to_end(EventLoop& loop, StruckBeam& beam, std::optional<NoMoreContact>& no_more_contact,
                const Progress& progress, Result& result) {
  loop.start();
  for (long n = 1; !loop.finished(); ++n) {
    loop.advance();
    if (no_more_contact && n % proof_interval == 0 &&
        no_more_contact->is_proven(beam, loop.state())) {
      result.no_more_contact = loop.time();
      result.outcome.message = "no further contact is possible";
      return;
    }
    if (n % progress_interval == 0 && progress && !progress(loop.time())) {
      result.outcome = {OutcomeKind::stopped, loop.time(), "stopped on request", {}};
      return;
    }
  }
}

void fail(Outcome& outcome, const RunStopped& stop) {
  outcome.kind = stop.kind;
  outcome.message = stop.what();
  outcome.first_failure = stop.first_failure;
}

// The last state is judged however the run ended.
void judge_end(Audit& audit, const EventLoop& loop, Outcome& outcome) {
  if (outcome.first_failure) return;
  try {
    audit.check(loop.time(), loop.state());
  } catch (const RunStopped& stop) {
    if (outcome.kind == OutcomeKind::solver_failed) {
      outcome.first_failure = stop.first_failure;
    } else {
      fail(outcome, stop);
    }
  }
}

}  // namespace

Result simulate(StruckBeam& beam, Integrator& integrator, const RunOptions& options,
                const Progress& progress, Observer* observer) {
  const auto start = std::chrono::steady_clock::now();
  Result result;
  Audit audit(beam, beam.initial_state(), options.limits);
  Recorder recorder(beam, options.history_interval, options.loop.events, audit, result);
  recorder.keep_sections(options.sections);
  std::optional<Observers> observers;
  if (observer != nullptr) observers.emplace(recorder, *observer);
  RunObserver& watching = observers ? static_cast<RunObserver&>(*observers) : recorder;
  EventLoop loop(beam, integrator, watching, audit, options.loop);
  std::optional<NoMoreContact> no_more_contact;
  if (options.stops_without_contact) no_more_contact.emplace(beam, *options.stops_without_contact);
  result.work.setup_seconds = seconds_since(start);

  try {
    result.outcome.message = "completed";
    run_to_end(loop, beam, no_more_contact, progress, result);
  } catch (const RunStopped& stop) {
    fail(result.outcome, stop);
  } catch (const IntegrationFailure& failure) {
    result.outcome.kind = OutcomeKind::solver_failed;
    result.outcome.message = failure.what();
  }
  judge_end(audit, loop, result.outcome);
  result.outcome.time =
      result.outcome.first_failure ? result.outcome.first_failure->to : loop.time();
  recorder.finish(loop.time(), loop.state(), beam, !result.outcome.first_failure);
  assign_zones(result.sub_impacts, options.zone_gap, options.subzone_gap);

  if (options.fixed_step) warn_of_short_contacts(recorder, *options.fixed_step, result);
  count_work(integrator, beam, loop, result.work);
  if (result.outcome.kind == OutcomeKind::inaccurate && audit.gained_energy() &&
      loop.energy_keeps_growing()) {
    result.outcome.kind = OutcomeKind::unstable;
    result.outcome.message = "the solution grows without bound: " + result.outcome.message;
  }
  result.work.wall_seconds = seconds_since(start);
  return result;
}

}  // namespace subimpact
