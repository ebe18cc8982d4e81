#include "subimpact/case/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "case/model_factory.h"
#include "simulate/event_loop.h"
#include "simulate/recorder.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/case/doubtful_units.h"
#include "system/no_more_contact.h"

namespace subimpact {
namespace {

constexpr long progress_interval = 512;  // steps
constexpr long proof_interval = 32;

// A contact of fewer steps is not resolved.
constexpr long fewest_steps_in_contact = 8;

constexpr double us = 1e6;  // per second

// The sections nearest to the positions asked for; in a half model their mirror images stand for
// those of the other half.
std::vector<std::size_t> sections_at(const Case& input, const BeamMesh& mesh) {
  std::vector<std::size_t> sections;
  const auto& positions = mesh.section_positions();
  for (const double fraction : input.output.sections) {
    const double modelled = mesh.symmetric() ? std::min(fraction, 1.0 - fraction) : fraction;
    const double x = modelled * input.scene.beam.length;
    const auto nearest =
        std::min_element(positions.begin(), positions.end(),
                         [x](double a, double b) { return std::abs(a - x) < std::abs(b - x); });
    sections.push_back(static_cast<std::size_t>(nearest - positions.begin()));
  }
  return sections;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// What helps when the integrator could not go on.
std::string remedy(const Case& input) {
  return input.solver.step ? "use a smaller solver.step or another solver.method"
                           : "use a larger solver.rtol or another solver.method";
}

// What helps when a check failed.
std::string remedy_of_error(const Case& input, const Used& used) {
  return used.step ? fmt::format("use a solver.step below {:.3g} us, or another solver.method",
                                 us * *used.step)
                   : fmt::format("use a solver.rtol below {:.0e}, or another solver.method",
                                 input.solver.rtol);
}

Outcome outcome_of(const RunStopped& stop, const Case& input, const Used& used) {
  Outcome outcome;
  outcome.kind = stop.kind;
  outcome.message = stop.what();
  outcome.first_failure = stop.first_failure;
  if (stop.first_failure) outcome.message += "; " + remedy_of_error(input, used);
  return outcome;
}

// The last state is judged however the run ended.
void judge_end(Audit& audit, const EventLoop& loop, const Case& input, Result& result) {
  if (result.outcome.first_failure) return;
  try {
    audit.check(loop.time(), loop.state());
  } catch (const RunStopped& stop) {
    if (result.outcome.kind == OutcomeKind::solver_failed) {
      result.outcome.first_failure = stop.first_failure;
    } else {
      result.outcome = outcome_of(stop, input, result.used);
    }
  }
}

// With a fixed step contacts may be too short for it although the accounts close.
void warn_of_short_contacts(const Recorder& recorder, const Used& used, Result& result) {
  if (!used.step) return;
  const auto& steps = recorder.steps_in_contact();
  const auto n_short =
      std::count_if(steps.begin(), steps.end(), [](long n) { return n < fewest_steps_in_contact; });
  if (n_short == 0) return;
  result.warnings.push_back(
      fmt::format("{} of {} contacts last fewer than {} steps of {:.4g} us, the shortest {}: their "
                  "times, forces and even their number are uncertain; use a smaller solver.step",
                  n_short, steps.size(), fewest_steps_in_contact, us * *used.step,
                  *std::min_element(steps.begin(), steps.end())));
}

void count_work(const Integrator& integrator, const StruckBeam& beam, Work& work) {
  const WorkCounts counts = integrator.work();
  work.steps = counts.steps;
  work.rejected_steps = counts.rejected_steps;
  work.partial_steps = counts.partial_steps;
  work.right_hand_sides = beam.n_accelerations() + beam.n_forces();
  const bool in_modes = !beam.mesh().modal_stiffness().empty();  // where mass is diagonal
  work.mass_solves =
      in_modes ? 0 : beam.n_accelerations() + beam.n_further_solves() + counts.mass_solves;
  work.jacobians = counts.jacobians;
  work.factorisations = (in_modes ? 0 : 1) + counts.factorisations;
  work.nonlinear_iterations = counts.nonlinear_iterations;
  work.nonlinear_failures = counts.nonlinear_failures;
}

}  // namespace

Used explain(const Case& input) {
  check(input);
  return describe(input, make_struck_beam(input));
}

Result simulate(const Case& input, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  check(input);
  StruckBeam beam = make_struck_beam(input);
  Result result;
  result.warnings = doubtful_units(input);
  result.used = describe(input, beam);
  beam.set_pair_detection(input.solver.pair_detection);
  const auto integrator = make_integrator(input, result.used, beam);
  Audit audit(beam, beam.initial_state(), audit_limits(result.used));
  Recorder recorder(beam, input.output.interval, result.used.events, audit, result);
  recorder.keep_sections(sections_at(input, beam.mesh()));
  EventLoop loop(beam, *integrator, recorder, audit, loop_options(input, result.used));
  std::optional<NoMoreContact> no_more_contact;
  if (input.stop == StopRule::no_more_contact) no_more_contact.emplace(beam, input.scene.beam);
  result.work.setup_seconds = seconds_since(start);

  try {
    result.outcome.message = "completed";
    loop.start();
    for (long n = 1; !loop.finished(); ++n) {
      loop.advance();
      if (no_more_contact && n % proof_interval == 0 &&
          no_more_contact->is_proven(beam, loop.state())) {
        result.no_more_contact = loop.time();
        result.outcome.message = "no further contact is possible";
        break;
      }
      if (n % progress_interval == 0 && progress && !progress(loop.time())) {
        result.outcome = {OutcomeKind::stopped, loop.time(), "stopped on request", {}};
        break;
      }
    }
  } catch (const RunStopped& stop) {
    result.outcome = outcome_of(stop, input, result.used);
  } catch (const IntegrationFailure& failure) {
    result.outcome.kind = OutcomeKind::solver_failed;
    result.outcome.message = failure.what() + ("; " + remedy(input));
  }
  judge_end(audit, loop, input, result);
  result.outcome.time =
      result.outcome.first_failure ? result.outcome.first_failure->to : loop.time();
  recorder.finish(loop.time(), loop.state(), beam, !result.outcome.first_failure);
  assign_zones(result.sub_impacts, input.output.zone_gap * result.used.first_period,
               input.output.subzone_gap * result.used.first_period);

  warn_of_short_contacts(recorder, result.used, result);
  count_work(*integrator, beam, result.work);
  result.work.roots = loop.n_events();
  if (result.outcome.kind == OutcomeKind::inaccurate && audit.gained_energy() &&
      loop.energy_keeps_growing()) {
    result.outcome.kind = OutcomeKind::unstable;
    result.outcome.message = "the solution grows without bound: " + result.outcome.message;
  }
  result.work.wall_seconds = seconds_since(start);
  return result;
}

}  // namespace subimpact
