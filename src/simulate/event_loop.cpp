#include "simulate/event_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "numerics/hermite.h"
#include "numerics/trajectory_root.h"

namespace subimpact {
namespace {

// Roots are found to rounding.
constexpr double root_tolerance = 8.0 * std::numeric_limits<double>::epsilon();

// Within the shortest time that a contact takes there is room for a begin, a yield, an unloading
// and an end. Many times as many events are chattering.
constexpr long most_events_in_place = 64;

// By how many times the rounding of displacements, velocities and times a located event may miss
// its guard.
constexpr double tolerated_rounding = 64.0;

// Rounding of the velocity at which the contact closes, as part of the striker's: it is the
// difference of two velocities, each a sum over the stages of a step.
constexpr double velocity_rounding = 1e-12;

// How far a run whose energy is off is followed to see whether it blows up.
constexpr long most_steps_ahead = 20000;

constexpr double us = 1e6;  // per second

}  // namespace

EventLoop::EventLoop(StruckBeam& beam, Integrator& integrator, RunObserver& observer, Audit& audit,
                     LoopOptions options)
    : beam_(beam),
      integrator_(integrator),
      observer_(&observer),
      audit_(&audit),
      options_(options) {
  beam_.set_contact_evaluation(options.events == EventHandling::located
                                   ? StruckBeam::Evaluation::smooth
                                   : StruckBeam::Evaluation::switching);
  const bool smooth_sections =
      options.events == EventHandling::located && std::isfinite(options.kink_tolerance);
  beam_.set_section_evaluation(
      smooth_sections ? StruckBeam::Evaluation::smooth : StruckBeam::Evaluation::switching,
      options.kink_tolerance);
}

void EventLoop::start() {
  const State y = beam_.initial_state();
  end_state_ = y;
  state_ = &end_state_;
  beam_.commit(y);
  report({EventKind::contact_begins}, 0.0, y, true);
  start_from(y);
}

void EventLoop::start_from(const State& y) {
  time_ = 0.0;
  beam_.commit(y);
  end_state_ = y;
  state_ = &end_state_;  // where the run stands if the integrator cannot even begin
  integrator_.restart(0.0, y);
  state_ = &integrator_.state();
}

void EventLoop::advance() {
  integrator_.step();
  ++n_steps_;
  state_ = &integrator_.start_state();  // until the step's end is found good
  check_step_end(integrator_.state());
  const bool suspicious = audit_->is_suspicious(integrator_.time(), integrator_.state());
  if (options_.events == EventHandling::located) {
    locate_events();
  } else {
    interpolate_events();
  }
  check_accepted(suspicious);
  observer_->on_accepted(time_, *state_, beam_);
}

void EventLoop::check_step_end(const State& y) {
  if (!(beam_.indentation(y) >= options_.largest_indentation)) return;
  audit_->check(integrator_.time(), y);  // a blow-up is called by its name
  throw RunStopped(OutcomeKind::left_validity,
                   "the indentation reached the beam's thickness, where the contact law ends; "
                   "reduce striker.velocity or striker.mass, or make the contact stiffer");
}

void EventLoop::check_accepted(bool now) {
  if (now || finished() || n_steps_ % options_.audit_interval == 0) audit_->check(time_, *state_);
}

bool EventLoop::energy_keeps_growing() {
  Audit without_limits = audit_->without_limits();
  RunObserver nobody;
  audit_ = &without_limits;
  observer_ = &nobody;
  const State y = *state_;
  try {
    integrator_.restart(time_, y);
    for (long n = 0; n < most_steps_ahead && !finished(); ++n) {
      advance();
      audit_->check(time_, *state_);
    }
  } catch (const RunStopped& stop) {
    return stop.kind == OutcomeKind::unstable;
  } catch (const IntegrationFailure&) {
  }
  return false;
}

StepEnds EventLoop::step_to_end_time() {
  const double end = std::min(integrator_.time(), options_.end_time);
  const State* y1 = &integrator_.state();
  if (end < integrator_.time()) {
    integrator_.state_at(end, end_state_);
    y1 = &end_state_;
  }
  return {integrator_.start_time(), end, integrator_.start_state(), *y1,
          integrator_.is_event_free()};
}

void EventLoop::locate_events() {
  const StepEnds whole = step_to_end_time();
  const State& y0 = whole.y0;
  const double t0 = whole.t0;
  double t1 = whole.t1;
  const State* y1 = &whole.y1;
  const auto end_at_event_state = [&](double time) {
    t1 = time;
    y1 = &event_state_;
  };
  std::optional<Guard> event;
  Crossing crossing;
  for (;;) {
    // The earliest event by estimate is located; the step then ends there, and what remains of it
    // is looked at again, in case an estimate had the order wrong.
    event.reset();
    dealt_with_.clear();
    while (beam_.find_crossing({t0, t1, y0, *y1, whole.event_free}, dealt_with_, crossing)) {
      const StepEnds step{t0, t1, y0, *y1};
      dealt_with_.push_back(crossing.guard);
      if (crossing.in_doubt && !confirm(crossing, step)) continue;
      const double time = locate(crossing, step);
      std::swap(event_state_, trial_state_);
      end_at_event_state(time);
      event = crossing.guard;
    }
    const double good_until = beam_.find_section_kinks({t0, t1, y0, *y1, whole.event_free});
    if (good_until < t1) {
      integrator_.state_at(good_until, event_state_);
      end_at_event_state(good_until);
      event.reset();
      continue;
    }
    if (!event || beam_.section_kinks().empty()) break;
    if (!relocate(*event, {t0, t1, y0, *y1}, whole.t1, t1)) event.reset();
    break;
  }
  observer_->on_step({t0, t1, y0, *y1, whole.event_free}, beam_, integrator_);
  const bool kinked = !beam_.section_kinks().empty();
  if (kinked) put_sections_right(y1);
  time_ = t1;
  state_ = y1;
  if (event) {
    report(*event, t1, *y1, true);
  } else {
    beam_.commit(*y1);
    if (!kinked && t1 == whole.t1) return;
  }
  integrator_.restart(t1, *y1);
  state_ = &integrator_.state();
}

void EventLoop::put_sections_right(const State*& y) {
  if (y != &event_state_) event_state_ = *y;
  y = &event_state_;
  beam_.put_right(event_state_);
  turns_.clear();
  for (const SectionKink& kink : beam_.section_kinks()) {
    if (!kink.turn) continue;
    turns_.push_back(
        {kink.turn->time, EventKind::section_reverses, kink.section, kink.turn->curvature});
  }
  std::sort(turns_.begin(), turns_.end(),
            [](const Transition& a, const Transition& b) { return a.time < b.time; });
  for (const Transition& turn : turns_) observer_->on_turn(turn);
}

bool EventLoop::relocate(const Guard& guard, const StepEnds& step, double latest, double& time) {
  RootOptions options;
  options.tolerance = root_tolerance * step.t1;
  // The state at t without the kinks is left in event_state_.
  const auto guard_at = [&](double t) {
    integrator_.state_at(t, event_state_);
    beam_.find_section_kinks({step.t0, t, step.y0, event_state_});
    trial_state_ = event_state_;
    beam_.add_kinks(trial_state_);
    return beam_.evaluate(guard, trial_state_);
  };
  trial_state_ = event_state_;
  beam_.add_kinks(trial_state_);
  const GuardValue here = beam_.evaluate(guard, trial_state_);
  if (std::abs(here.value) <= rounding_of(guard, trial_state_, step.t1, here)) return true;
  if (here.value > 0.0) {
    time = find_rise(guard_at, step.t0, step.t1, step.t1 - here.value / here.rate, options);
    return true;
  }
  // Not reached yet: a little later, if the guard rises fast enough to be sure of it.
  const double ahead = std::min(step.t1 - 2.0 * here.value / here.rate, latest);
  if (here.rate > 0.0 && ahead > step.t1 && guard_at(ahead).value > 0.0) {
    time = find_rise(guard_at, step.t1, ahead, step.t1 - here.value / here.rate, options);
    return true;
  }
  guard_at(step.t1);
  return false;
}

double EventLoop::rounding_of(const Guard& guard, const State& y, double time,
                              const GuardValue& at) const {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const double of_value = guard.kind == EventKind::contact_unloads
                              ? velocity_rounding * beam_.scales().velocity
                              : beam_.negligible_excursion(y);
  return of_value + epsilon * time * std::abs(at.rate);
}

bool EventLoop::confirm(Crossing& crossing, const StepEnds& step) {
  // The top of the hump is where the indentation turns: from growing, or from falling for the end
  // of contact.
  const double sense = crossing.guard.kind == EventKind::contact_ends ? -1.0 : 1.0;
  const Guard turn{EventKind::contact_unloads, sense};
  RootOptions options;
  options.tolerance = root_tolerance * step.t1;
  const double top = find_rise(
      [&](double t) {
        integrator_.state_at(t, trial_state_);
        return beam_.evaluate(turn, trial_state_);
      },
      step.t0, step.t1, crossing.guess, options);
  if (!(beam_.evaluate(crossing.guard, trial_state_).value >
        beam_.negligible_excursion(trial_state_))) {
    return false;
  }
  crossing.before = top;
  crossing.guess = 0.5 * (crossing.after + top);
  return true;
}

double EventLoop::locate(const Crossing& crossing, const StepEnds& step) {
  if (!(crossing.before > step.t0)) {  // it happened at the start
    trial_state_ = step.y0;
    return step.t0;
  }
  RootOptions options;
  options.tolerance = root_tolerance * step.t1;
  const auto guard_at = [&](double t) {
    integrator_.state_at(t, trial_state_);
    return beam_.evaluate(crossing.guard, trial_state_);
  };
  double after = crossing.after;
  double before = crossing.before;
  double guess = crossing.guess;
  // Where the cubic put the guard's lowest point it may already have been crossed again.
  if (after > step.t0 && guard_at(after).value > 0.0) {
    before = after;
    after = step.t0;
    guess = 0.5 * (after + before);
  }
  return find_rise(guard_at, after, before, guess, options);
}

ContactBranch EventLoop::branch_after(EventKind kind) {
  if (kind == EventKind::contact_yields) return ContactBranch::plastic;
  return kind == EventKind::contact_ends ? ContactBranch::separated : ContactBranch::elastic;
}

void EventLoop::report(const Guard& guard, double time, const State& y, bool switch_branch) {
  Transition event;
  event.time = time;
  event.kind = guard.kind;
  event.value = beam_.indentation(y);
  if (switch_branch) check_root(guard, time, y);
  watch_for_chattering(time);
  const bool audited = observer_->audits_events();
  if (!audited) audit_->check(time, y);
  ++n_events_;
  observer_->before_event(event, y, beam_);
  if (switch_branch) {
    beam_.commit(y);
    beam_.apply(guard, y);
  } else {
    beam_.set_contact(branch_after(guard.kind), beam_.contact_history());
  }
  if (!audited) audit_->check(time, y);
  observer_->after_event(event, y, beam_);
}

void EventLoop::check_root(const Guard& guard, double time, const State& y) {
  const GuardValue at = beam_.evaluate(guard, y);
  const double tolerated = tolerated_rounding * rounding_of(guard, y, time, at);
  if (!(std::abs(at.value) <= tolerated)) {
    audit_->fail(time, OutcomeKind::inaccurate,
                 fmt::format("{} was located at {:.6g} us, but its condition is missed there by "
                             "{:.2e} {}, tolerated are {:.1e}",
                             to_string(guard.kind), us * time, at.value,
                             guard.kind == EventKind::contact_unloads ? "m/s" : "m", tolerated));
  }
  if (!(time >= last_event_)) {
    audit_->fail(time, OutcomeKind::inaccurate,
                 fmt::format("{} was located at {:.6g} us, before the event that precedes it",
                             to_string(guard.kind), us * time));
  }
  if (guard.kind == EventKind::contact_begins) contact_start_ = time;
  if (guard.kind == EventKind::contact_ends && !(time > contact_start_)) {
    audit_->fail(
        time, OutcomeKind::inaccurate,
        fmt::format("the contact that begins at {:.6g} us ends at the same instant", us * time));
  }
  last_event_ = time;
}

void EventLoop::watch_for_chattering(double time) {
  if (time - events_since_ > options_.shortest_contact) {
    events_since_ = time;
    n_events_in_place_ = 0;
  }
  if (++n_events_in_place_ <= most_events_in_place) return;
  audit_->fail(time, OutcomeKind::chattering,
               fmt::format("the contact changed its state {} times within {:.2e} us",
                           n_events_in_place_, us * (time - events_since_)));
}

std::vector<EventLoop::Interpolated> EventLoop::events_within(const StepEnds& step,
                                                              ContactBranch after) {
  const ContactBranch before = beam_.contact_branch();
  const double threshold = beam_.contact_law().yield_threshold(beam_.contact_history());
  const double residual = beam_.residual_indentation();
  const double lambda0 = beam_.indentation(step.y0);
  const double lambda1 = beam_.indentation(step.y1);
  const double rate0 = beam_.indentation_rate(step.y0);
  const double rate1 = beam_.indentation_rate(step.y1);
  std::vector<Interpolated> events;
  const auto add = [&](EventKind kind, double s) {
    events.push_back({kind, step.t0 + s * step.length()});
  };
  const auto rise = [&](EventKind kind, double level, double sign) {
    const HermiteCubic path(sign * (lambda0 - level), sign * rate0, sign * (lambda1 - level),
                            sign * rate1, step.length());
    add(kind, path.rise(0.0, 1.0));
  };
  if (before == ContactBranch::separated) rise(EventKind::contact_begins, residual, 1.0);
  if (before == ContactBranch::plastic) {
    add(EventKind::contact_unloads, rate0 > 0.0 && rate1 < 0.0 ? rate0 / (rate0 - rate1) : 0.0);
  }
  if (after == ContactBranch::plastic) rise(EventKind::contact_yields, threshold, 1.0);
  if (after == ContactBranch::separated) rise(EventKind::contact_ends, residual, -1.0);
  std::stable_sort(events.begin(), events.end(),
                   [](const Interpolated& a, const Interpolated& b) { return a.time < b.time; });
  return events;
}

void EventLoop::interpolate_events() {
  const StepEnds step = step_to_end_time();
  const ContactBranch after =
      beam_.contact_law().branch(beam_.contact_history(), beam_.indentation(step.y1));
  double t0 = step.t0;
  const State* y0 = &step.y0;
  bool from_end = false;
  if (after != beam_.contact_branch()) {
    for (const Interpolated& event : events_within(step, after)) {
      // Forces act at the ends of steps: before contact begins the motion is that of the step's
      // start, after it ends that of the step's end, both without the contact force.
      from_end = event.kind == EventKind::contact_ends;
      trial_state_ = *y0;
      if (from_end) {
        integrator_.state_before_end(event.time, event_state_);
      } else {
        integrator_.state_at(event.time, event_state_);
      }
      observer_->on_step({t0, event.time, trial_state_, event_state_}, beam_, integrator_);
      report({event.kind}, event.time, event_state_, false);
      t0 = event.time;
      y0 = &event_state_;
    }
    beam_.follow_branch(step.y1);
  }
  StepEnds rest{t0, step.t1, *y0, step.y1};
  rest.from_end = from_end;
  observer_->on_step(rest, beam_, integrator_);
  beam_.commit(step.y1);
  time_ = step.t1;
  state_ = &step.y1;
}

}  // namespace subimpact
