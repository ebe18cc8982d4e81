#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>

#include "numerics/units.h"
#include "simulate/records/recorder.h"
#include "simulate/run_parts.h"
#include "simulate/settings/methods.h"
#include "simulate/settings/refuse.h"
#include "subimpact/model/contact/contact_law.h"
#include "system/flight/no_more_contact.h"

namespace subimpact {
namespace {

constexpr long progress_interval = 512;  // steps
constexpr long proof_interval = 32;

// The first step of a contact by methods that would begin with that of the flight before it, over
// the time that short contacts take.
constexpr double first_part_of_contact = 0.1;

// A contact of fewer steps is not resolved.
constexpr long fewest_steps_in_contact = 8;

constexpr double tolerated_momentum = 1e-9;

// A contact under loads that lasts so many times as long as one without does not end by itself.
constexpr double contacts_of_rest = 20.0;

// How far the section correction of a step may be off, as part of the striker's velocity. At rtol
// the error is a third of what the integrator may add, root mean square over the steps of the
// paper's beam. A smaller tolerance cuts steps at section events, some thousand in 8 ms, however
// small rtol is: at rtol 1e-8 those cost more than they gain, at 1e-12 a share of 1e-8 adds a tenth
// of the time and takes nine tenths (paper's beam) to 99.9 % (slender beams without rotary inertia)
// off the errors of events.
double correction_tolerance(double rtol) {
  constexpr double cheap_from = 1e-8;
  constexpr double least = 1e-20;
  const double ratio = std::min(1.0, rtol / cheap_from);
  return std::max(least, rtol * ratio * ratio);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Contacts may be too short for a fixed step although the accounts close. A contact cut off by the
// end of the run has no known length.
void warn_of_short_contacts(const Recorder& recorder, const ResolvedSettings& used,
                            Result& result) {
  if (!used.step) return;
  std::vector<long> steps = recorder.steps_in_contact();
  if (!result.sub_impacts.empty() && !result.sub_impacts.back().end) steps.pop_back();
  const auto n_short =
      std::count_if(steps.begin(), steps.end(), [](long n) { return n < fewest_steps_in_contact; });
  if (n_short == 0) return;
  result.warnings.push_back(
      fmt::format("{} of {} contacts last fewer than {} steps of {:.4g} us, the shortest {}: their "
                  "times, forces and even their number are uncertain; use a smaller solver.step",
                  n_short, steps.size(), fewest_steps_in_contact, us * *used.step,
                  *std::min_element(steps.begin(), steps.end())));
}

// A tolerance that numbers of 16 digits cannot meet costs steps and gains nothing.
void warn_of_rounding(double rtol, const StruckBeam& beam, const State& y, Result& result) {
  const double rounding = beam.displacement_rounding(y) / beam.scales().position;
  if (rtol >= rounding) return;
  result.warnings.push_back(fmt::format(
      "solver.rtol = {:.1e} is below {:.1e}, the rounding of displacements at the end of the run: "
      "it takes more steps, and events are known to {:.1e} us at best, however small it is",
      rtol, rounding, us * rounding * beam.scales().position / beam.scales().velocity));
}

void count_work(const Integrator& integrator, const StruckBeam& beam, const EventLoop& loop,
                Work& work) {
  const WorkCounts counts = integrator.work();
  static_cast<WorkCounts&>(work) = counts;
  work.right_hand_sides = beam.n_accelerations() + beam.n_forces();
  const bool in_modes = !beam.mesh().modal_stiffness().empty();  // where mass is diagonal
  work.mass_solves =
      in_modes ? 0 : beam.n_accelerations() + loop.n_correction_solves() + counts.mass_solves;
  work.factorisations += in_modes ? 0 : 1;
  work.roots = loop.n_events();
  work.section_flows = beam.n_flows();
}

// Steps to the end, or to where the run is stopped.
void run_to_end(EventLoop& loop, RunParts& parts, const Progress& progress,
                const Observer* observer, Result& result) {
  loop.start();
  std::optional<NoMoreContact> no_more_contact;
  const auto is_over = [&] {
    if (parts.beam.contact().is_closed()) return false;
    if (!no_more_contact) {
      no_more_contact.emplace(parts.beam, parts.problem.beam, parts.settings.first_period);
    }
    return no_more_contact->is_proven(parts.beam, loop.state());
  };
  const StopRule stop = parts.given.stop;
  for (long n = 1; !loop.finished(); ++n) {
    loop.advance();
    if (stop == StopRule::no_more_contact && n % proof_interval == 0 && is_over()) {
      result.no_more_contact = loop.time();
      result.outcome.message = "no further contact is possible";
      return;
    }
    const bool is_stopped = (observer != nullptr && !observer->goes_on()) ||
                            (n % progress_interval == 0 && progress && !progress(loop.time()));
    if (is_stopped) {
      result.outcome = {OutcomeKind::stopped, loop.time(), "stopped on request", {}};
      return;
    }
  }
  if (is_over()) result.no_more_contact = loop.time();
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

// Adds a remedy to the message, if the integrator could not continue or a check failed.
void add_remedy(Outcome& outcome, const RunParts& parts) {
  const std::optional<double>& step = parts.settings.step;
  const bool failed = outcome.kind == OutcomeKind::solver_failed;
  std::vector<std::string_view> own;  // parts that are the caller's
  if (parts.problem.check_mesh) own.emplace_back("mesh");
  if (parts.problem.check_contact_law) own.emplace_back("contact law");
  if (parts.given.solver.method == Method::own) own.emplace_back("integrator");
  if (!own.empty() && (failed || outcome.first_failure)) {
    outcome.message += fmt::format(
        "; check the {} of your own first: samples before the run showed no broken rule",
        fmt::join(own, " and "));
  } else if (failed) {
    outcome.message += parts.given.solver.step
                           ? "; use a smaller solver.step or another solver.method"
                           : "; use a larger solver.rtol or another solver.method";
  } else if (outcome.first_failure) {
    outcome.message +=
        step ? fmt::format("; use a solver.step below {:.3g} us, or another solver.method",
                           us * *step)
             : fmt::format("; use a solver.rtol below {:.0e}, or another solver.method",
                           parts.given.solver.rtol);
  }
}

// A law that is wrong from the start makes a result that is wrong from the start. The largest
// indentation of the run bounds what is looked at.
std::optional<std::string> rule_broken_by_law(const RunParts& parts) {
  if (!parts.problem.check_contact_law) return std::nullopt;
  const ContactLaw& law = parts.beam.contact().law();
  const double mass = parts.problem.bodies().moving_mass();
  const double speed = parts.problem.bodies().velocity_scale();
  const double deepest =
      law.indentation_at(std::max(parts.settings.initial_energy, 0.5 * mass * speed * speed));
  const double most = std::min(parts.problem.beam.height(), law.largest_indentation());
  // NaN of a law that gives no energy to compare with.
  return broken_rule(law, deepest < most && deepest > 0.0 ? deepest : most);
}

}  // namespace

LoopOptions loop_options(const RunParts& parts) {
  const Options& given = parts.given;
  const ResolvedSettings& used = parts.settings;
  LoopOptions loop;
  loop.end_time = given.end_time;
  loop.begins_apart = parts.problem.bodies().has_approach_to_compute();
  if (!loop.begins_apart) loop.first_touch = parts.problem.striker.first_touch();
  loop.events = used.events;
  loop.double_roots = given.study.pair_detection;
  if (used.reversals == ReversalHandling::located) {
    loop.correction_tolerance =
        correction_tolerance(given.solver.rtol) * parts.beam.scales().velocity;
  }
  const ContactLaw& law = parts.beam.contact().law();
  // A spring may be a pad or a bumper, thicker than the beam.
  const bool is_spring = law.scales().exponent == 1.0 && std::isinf(law.yield_threshold({}));
  // Of a plane only the law that models its columns knows the height.
  const bool on_plane = parts.problem.beam.fixed && law.limit() != ContactLaw::Limit::height;
  loop.largest_indentation = is_spring || on_plane ? HUGE_VAL : parts.problem.beam.height();
  if (const double deepest = law.largest_indentation(); deepest < loop.largest_indentation) {
    loop.largest_indentation = deepest;
    const bool is_measured = law.limit() == ContactLaw::Limit::last_point;
    loop.end_of_law = fmt::format("{:.4g} mm, {}", mm * deepest,
                                  is_measured ? "the last point of contact.curve_indentation"
                                              : "where the contact is as wide as the law \"" +
                                                    law.name() + "\" allows on this beam");
    if (is_measured) {
      loop.remedy = "add points to it and to contact.curve_force, or " + loop.remedy;
    }
  }
  loop.audit_interval = descriptor_of(given.solver.method).audit_interval;
  loop.shortest_contact = M_PI / used.joined_frequency;
  loop.first_step_of_contact = first_part_of_contact * used.contact_time;
  return loop;
}

// Whether the solution grows without bound in the steps that follow those of a run whose energy is
// too high. No observer receives them.
bool grows_without_bound(const EventLoop& run, const Audit& audit, Integrator& integrator,
                         RunParts& parts) {
  constexpr long most_steps = 20000;
  Audit without_limits = audit.without_limits();
  RunObserver nobody;
  LoopOptions options = loop_options(parts);
  options.first_touch = run.time();
  EventLoop ahead(parts.beam, integrator, nobody, without_limits, options);
  try {
    ahead.start_from(run.state());
    for (long n = 0; n < most_steps && !ahead.finished(); ++n) {
      ahead.advance();
      without_limits.check(ahead.time(), ahead.state());
    }
  } catch (const RunStopped& stop) {
    return stop.kind == OutcomeKind::unstable;
  } catch (const IntegrationFailure&) {
  }
  return false;
}

Result simulate(RunParts& parts, Integrator& integrator, const Progress& progress,
                Observer* observer, RowSink* rows) {
  const auto start = std::chrono::steady_clock::now();
  const ResolvedSettings& used = parts.settings;
  const OutputOptions& output = parts.given.output;
  StruckBeam& beam = parts.beam;
  Result result;
  if (parts.problem.start) begin_next_strike(parts);
  // The impulses of supports that lift are integrals over steps.
  const double momentum = beam.supports().empty() ? tolerated_momentum : used.energy_tolerance;
  Audit audit(beam, beam.initial_state(), {used.energy_tolerance, momentum});
  Recorder recorder(beam, output.history_interval(parts.given.end_time), used.events, audit, result,
                    rows);
  if (!output.interval) recorder.follow_force();
  recorder.keep_fields(parts);
  if (observer != nullptr) recorder.show(*observer);
  EventLoop loop(beam, integrator, recorder, audit, loop_options(parts));
  result.work.setup_seconds = seconds_since(start);

  try {
    result.outcome.message = "completed";
    run_to_end(loop, parts, progress, observer, result);
  } catch (const RunStopped& stop) {
    fail(result.outcome, stop);
  } catch (const IntegrationFailure& failure) {
    result.outcome.kind = OutcomeKind::solver_failed;
    result.outcome.message = failure.what();
  } catch (const std::bad_alloc&) {
    result.outcome.kind = OutcomeKind::solver_failed;
    result.outcome.message = "the machine has no more memory for this run";
  }
  judge_end(audit, loop, result.outcome);
  result.outcome.time =
      result.outcome.first_failure ? result.outcome.first_failure->to : loop.time();
  result.contact_over = result.no_more_contact.has_value();
  if (result.is_usable()) result.end_state = beam.end_state(loop.state());
  recorder.finish(loop.time(), loop.state(), beam, !result.outcome.first_failure);
  const auto& contacts = result.sub_impacts;
  if (!contacts.empty() && !contacts.back().end && !beam.loads().is_empty() &&
      loop.time() - contacts.back().start > contacts_of_rest * used.contact_time) {
    result.rests_since = contacts.back().start;
  }
  warn_of_short_contacts(recorder, used, result);
  if (!used.step) warn_of_rounding(parts.given.solver.rtol, beam, loop.state(), result);
  join_sub_impacts(result.sub_impacts, output.opening);
  assign_zones(result.sub_impacts, output.zone_gap * used.first_period,
               output.subzone_gap * used.first_period);

  count_work(integrator, beam, loop, result.work);
  if (result.outcome.kind == OutcomeKind::inaccurate && audit.gained_energy() &&
      grows_without_bound(loop, audit, integrator, parts)) {
    result.outcome.kind = OutcomeKind::unstable;
    result.outcome.message = "the solution grows without bound: " + result.outcome.message;
  }
  result.work.wall_seconds = result.work.all_seconds = seconds_since(start);
  return result;
}

void check_memory(const ResolvedSettings& settings) {
  const double available = available_memory();
  if (settings.memory <= available) return;
  refuse(
      "solver.method",
      "takes some {:.2g} GB of memory on this mesh of {} unknowns, and the machine has {:.2g} GB "
      "free; use a coarser mesh, or a method that needs no natural modes, such as nystrom",
      1e-9 * settings.memory, settings.n_unknowns, 1e-9 * available);
}

Result simulate(ResolvedRun run, const Progress& progress, Observer* observer, RowSink* rows) {
  RunParts& parts = run.parts();
  const auto start = std::chrono::steady_clock::now();
  check_memory(parts.settings);
  parts.complete();
  Result result;
  if (const auto broken = rule_broken_by_law(parts)) {
    result.outcome = {OutcomeKind::inaccurate, 0.0, *broken, Interval{0.0, 0.0}};
  } else {
    const auto integrator = parts.make_integrator();
    const double setup_seconds = parts.setup_seconds + seconds_since(start);
    result = simulate(parts, *integrator, progress, observer, rows);
    result.work.setup_seconds += setup_seconds;
    result.work.wall_seconds = parts.setup_seconds + seconds_since(start);
    add_remedy(result.outcome, parts);
  }
  result.warnings.insert(result.warnings.begin(), parts.warnings.begin(), parts.warnings.end());
  if (parts.warnings_of_result) {
    const std::vector<std::string> more = parts.warnings_of_result(result);
    result.warnings.insert(result.warnings.end(), more.begin(), more.end());
  }
  result.given = std::move(parts.given);
  result.used = std::move(parts.settings);
  return result;
}

Result simulate(const Problem& problem, const Options& options, const Progress& progress,
                Observer* observer, RowSink* rows) {
  return simulate(resolve(problem, options), progress, observer, rows);
}

}  // namespace subimpact
