#include "simulate/event_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "events/hermite.h"
#include "events/root.h"

namespace subimpact {
namespace {

// Roots are found to rounding.
constexpr double root_tolerance = 8.0 * std::numeric_limits<double>::epsilon();

// How often the energy is looked at, in steps (and at the end), and by which part of the initial
// energy it may be off before the run is called unstable.
constexpr long energy_check_interval = 512;
constexpr double tolerated_energy_gain = 0.5;

}  // namespace

EventLoop::EventLoop(StruckBeam& beam, Integrator& integrator, RunObserver& observer,
                     LoopOptions options)
    : beam_(beam), integrator_(integrator), observer_(observer), options_(options) {
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
  beam_.commit(y);
  report({EventKind::contact_begins}, 0.0, y, true);
  start_from(y);
}

void EventLoop::start_from(const State& y) {
  time_ = 0.0;
  initial_energy_ = beam_.energies(y).total();
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
  check_state(integrator_.state());
  if (options_.events == EventHandling::located) {
    locate_events();
  } else {
    interpolate_events();
  }
}

void EventLoop::check_state(const State& y) {
  const double indentation = beam_.indentation(y);
  const bool too_deep = indentation >= options_.largest_indentation;
  const bool last = integrator_.time() >= options_.end_time;
  const bool looked_at = too_deep || last || n_steps_ % energy_check_interval == 0;
  const double energy = looked_at ? beam_.energies(y).total() : initial_energy_;
  if (!std::isfinite(indentation) || !std::isfinite(energy) ||
      energy > (1.0 + tolerated_energy_gain) * initial_energy_) {
    throw RunStopped(RunStopped::Reason::unstable,
                     "the solution grows without bound: total energy is no longer near its initial "
                     "value; use a smaller solver.step or another method");
  }
  if (too_deep) {
    throw RunStopped(
        RunStopped::Reason::left_validity,
        "the indentation reached the beam's thickness, where the contact law ends; reduce "
        "striker.velocity or striker.mass, or make the contact stiffer");
  }
}

StepEnds EventLoop::step_to_end_time() {
  const double end = std::min(integrator_.time(), options_.end_time);
  const State* y1 = &integrator_.state();
  if (end < integrator_.time()) {
    integrator_.state_at(end, end_state_);
    y1 = &end_state_;
  }
  return {integrator_.start_time(), end, integrator_.start_state(), *y1,
          integrator_.is_eventless()};
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
    while (beam_.find_crossing({t0, t1, y0, *y1, whole.eventless}, dealt_with_, crossing)) {
      const StepEnds step{t0, t1, y0, *y1};
      dealt_with_.push_back(crossing.guard);
      if (crossing.in_doubt && !confirm(crossing, step)) continue;
      const double time = locate(crossing, step);
      std::swap(event_state_, trial_state_);
      end_at_event_state(time);
      event = crossing.guard;
    }
    const double good_until = beam_.find_section_kinks({t0, t1, y0, *y1, whole.eventless});
    if (!(good_until < t1)) break;
    integrator_.state_at(good_until, event_state_);
    end_at_event_state(good_until);
  }
  observer_.on_step({t0, t1, y0, *y1, whole.eventless}, beam_, integrator_);
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
  for (const Transition& turn : turns_) observer_.on_turn(turn);
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

void EventLoop::report(const Guard& guard, double time, const State& y, bool switch_branch) {
  Transition event;
  event.time = time;
  event.kind = guard.kind;
  event.value = beam_.indentation(y);
  ++n_events_;
  observer_.before_event(event, y, beam_);
  if (switch_branch) {
    beam_.commit(y);
    beam_.apply(guard, y);
  }
  observer_.after_event(event, y, beam_);
}

void EventLoop::interpolate_events() {
  const StepEnds step = step_to_end_time();
  observer_.on_step(step, beam_, integrator_);

  const ContactBranch before = beam_.contact_branch();
  const double threshold = beam_.contact_law().yield_threshold(beam_.contact_history());
  const double residual = beam_.residual_indentation();
  beam_.follow_branch(step.y1);
  const ContactBranch after = beam_.contact_branch();
  if (before != after) {
    const double h = step.length();
    const double lambda0 = beam_.indentation(step.y0);
    const double lambda1 = beam_.indentation(step.y1);
    const double rate0 = beam_.indentation_rate(step.y0);
    const double rate1 = beam_.indentation_rate(step.y1);
    const auto event_at = [&](EventKind kind, double s) {
      integrator_.state_at(step.t0 + s * h, event_state_);
      report({kind}, step.t0 + s * h, event_state_, false);
    };
    const auto rise = [&](EventKind kind, double level, double sign) {
      const HermiteCubic path(sign * (lambda0 - level), sign * rate0, sign * (lambda1 - level),
                              sign * rate1, h);
      event_at(kind, path.rise(0.0, 1.0));
    };
    if (before == ContactBranch::separated) rise(EventKind::contact_begins, residual, 1.0);
    if (before == ContactBranch::plastic) {
      const double turn = rate0 > 0.0 && rate1 < 0.0 ? rate0 / (rate0 - rate1) : 0.0;
      event_at(EventKind::contact_unloads, turn);
    }
    if (after == ContactBranch::plastic) rise(EventKind::contact_yields, threshold, 1.0);
    if (after == ContactBranch::separated) rise(EventKind::contact_ends, residual, -1.0);
  }
  beam_.commit(step.y1);
  time_ = step.t1;
  state_ = &step.y1;
}

}  // namespace subimpact
