#include "simulate/loop/event_loop.h"

#include <algorithm>
#include <cmath>

#include "numerics/units.h"

namespace subimpact {
namespace {

// Within the shortest duration of a contact four events are possible: contact begins, yields,
// unloads and ends. Many more than four events count as chattering.
constexpr long most_events_in_place = 64;

// Tolerated value of the event function at a located event, in units of the rounding of
// displacements, velocities and times.
constexpr double tolerated_rounding = 64.0;

// Part of the time of an event beside which no other event is known from rounding: where the run
// ends so soon after one, it has no further one.
constexpr double end_rounding = 64.0 * std::numeric_limits<double>::epsilon();

ContactBranch branch_after(EventKind kind) {
  if (kind == EventKind::contact_yields) return ContactBranch::plastic;
  return kind == EventKind::contact_ends ? ContactBranch::separated : ContactBranch::elastic;
}

}  // namespace

EventLoop::EventLoop(StruckBeam& beam, Integrator& integrator, RunObserver& observer, Audit& audit,
                     const LoopOptions& options)
    : beam_(beam),
      integrator_(integrator),
      observer_(observer),
      audit_(audit),
      options_(options),
      corrector_(beam, options.correction_tolerance),
      locator_(beam, integrator, corrector_, options.events, options.double_roots),
      losses_(audit, options.events),
      watches_(beam.n_contacts()) {
  const bool located = options.events != EventHandling::interpolated;
  const bool corrects = located && std::isfinite(options.correction_tolerance);
  for (std::size_t i = 0; i < beam_.n_contacts(); ++i) {
    beam_.contact(i).set_evaluation(located ? Evaluation::smooth : Evaluation::switching);
  }
  beam_.set_section_evaluation(corrects ? Evaluation::smooth : Evaluation::switching);
}

void EventLoop::start() {
  const State y = beam_.initial_state();
  end_state_ = y;
  state_ = &end_state_;
  beam_.commit(y);
  if (options_.begins_apart) return start_from(y);
  if (options_.first_touch > 0.0) observer_.on_approach(options_.first_touch, beam_);
  report({EventKind::contact_begins}, options_.first_touch, y, true);
  start_from(y);
}

void EventLoop::start_from(const State& y) {
  beam_.commit(y);
  time_ = options_.first_touch;
  end_state_ = y;
  state_ = &end_state_;  // where the run stands if the integrator cannot even begin
  integrator_.restart(time_, end_state_);  // y may be a state of its own
  state_ = &integrator_.state();
  read_indentation();
}

void EventLoop::read_indentation() {
  indentation_.lambda1 = beam_.indentation(*state_);
  indentation_.rate1 = beam_.indentation_rate(*state_);
}

void EventLoop::advance() {
  integrator_.step();
  evaluations_at_end_ = beam_.n_accelerations();
  ++n_steps_;
  state_ = &integrator_.start_state();  // until the step's end is found good
  const State& end = integrator_.state();
  indentation_ = {integrator_.start_time(), integrator_.time(),     indentation_.lambda1,
                  indentation_.rate1,       beam_.indentation(end), beam_.indentation_rate(end)};
  check_step_end();
  const bool suspicious =
      audit_.is_suspicious(indentation_.t1, end, indentation_.lambda1, indentation_.rate1);
  if (options_.events == EventHandling::interpolated) {
    interpolate_events();
  } else {
    locate_events();
  }
  check_accepted(suspicious);
  observer_.on_accepted(time_, *state_, beam_);
}

void EventLoop::check_step_end() {
  // A step of flight may be long; only its part before the touch counts.
  if (!beam_.contact().is_closed() && options_.events != EventHandling::interpolated) return;
  if (!(indentation_.lambda1 >= options_.largest_indentation)) return;
  audit_.check(integrator_.time(), integrator_.state());  // a blow-up is called by its name
  throw RunStopped(OutcomeKind::left_validity,
                   "the indentation reached " + options_.end_of_law + "; " + options_.remedy);
}

StepEnds EventLoop::step_to_end_time() {
  const double end = std::min({integrator_.time(), options_.end_time, beam_.loads().next_corner()});
  const State* y1 = &integrator_.state();
  if (end < integrator_.time()) {
    integrator_.state_at(end, end_state_);
    y1 = &end_state_;
  }
  const double start = integrator_.start_time();
  const bool is_rounding = end == options_.end_time && end - start <= end_rounding * end;
  return {start, end, integrator_.start_state(), *y1, is_rounding || integrator_.is_event_free()};
}

IndentationStep EventLoop::indentation_of(const StepEnds& piece) const {
  IndentationStep ends = indentation_;
  ends.t0 = piece.t0;
  ends.t1 = piece.t1;
  if (&piece.y0 != &integrator_.start_state()) {
    ends.lambda0 = beam_.indentation(piece.y0);
    ends.rate0 = beam_.indentation_rate(piece.y0);
  }
  if (&piece.y1 != &integrator_.state()) {
    ends.lambda1 = beam_.indentation(piece.y1);
    ends.rate1 = beam_.indentation_rate(piece.y1);
  }
  return ends;
}

void EventLoop::show_piece(const StepEnds& piece, bool from_end) {
  const IndentationStep indentation = indentation_of(piece);
  const ObservedStep step(piece, indentation, integrator_, corrector_, from_end);
  observer_.on_step(step, beam_);
  if (beam_.has_losses()) {
    beam_.add_losses(losses_.over(step, step.t1(), step.y1(), beam_));
    beam_.add_support_impulses(losses_.support_impulses());
  }
}

void EventLoop::locate_events() {
  const StepEnds whole = step_to_end_time();
  const auto [t1, found, event] = locator_.find_end(whole, indentation_of(whole));
  const State* y1 = found;
  show_piece({whole.t0, t1, whole.y0, *y1, whole.event_free});
  const bool is_corrected = !locator_.correction().is_empty();
  if (is_corrected) {
    event_state_ = *y1;
    locator_.correction().add_to(event_state_);
    y1 = &event_state_;
    report_reversals();
  }
  time_ = t1;
  state_ = y1;
  if (event) {
    report(*event, t1, *y1, true);
    report_simultaneous(*event, t1, *y1);
  } else {
    beam_.commit(*y1);
  }
  const bool at_corner = pass_corner(t1, *y1);
  if (!event && !is_corrected && !at_corner && t1 == whole.t1) return;
  integrator_.restart(t1, *y1);
  if (event && event->contact == 0 && event->kind == EventKind::contact_begins) {
    integrator_.limit_next_step(options_.first_step_of_contact);
  }
  state_ = &integrator_.state();
  read_indentation();
}

bool EventLoop::pass_corner(double t, const State& y) {
  if (!(t >= beam_.loads().next_corner())) return false;
  beam_.begin_loads(y, t);
  return true;
}

void EventLoop::report_reversals() {
  reversals_.clear();
  for (const SectionEvent& event : locator_.correction().events) {
    if (!event.reversal) continue;
    const auto& [time, curvature] = *event.reversal;
    beam_.commit_reversal(event.section, curvature);
    reversals_.push_back({time, EventKind::section_reverses, event.section, curvature});
  }
  std::ranges::sort(reversals_, {}, &Transition::time);
  for (const Transition& reversal : reversals_) observer_.on_reversal(reversal);
}

void EventLoop::report_simultaneous(const EventFunction& event, double time, const State& y) {
  for (std::size_t i = 1; i < beam_.n_contacts(); ++i) {
    if (i == event.contact) continue;
    for (EventFunction function : beam_.contact(i).event_functions()) {
      function.contact = i;
      if (function.of_rate()) continue;
      const EventValue at = beam_.evaluate(function, y);
      const double rounding = rounding_of(function, beam_, y, time, at);
      const bool moves = at.rate * options_.shortest_contact > rounding;
      if (!moves || !(std::abs(at.value) <= rounding)) continue;
      report(function, time, y, true);
      break;
    }
  }
}

void EventLoop::report(const EventFunction& function, double time, const State& y,
                       bool changes_branch) {
  ContactState& contact = beam_.contact(function.contact);
  const double indentation = beam_.indentation(y, function.contact);
  if (function.kind == EventKind::contact_ends && contact.is_recovering()) {
    beam_.commit(y);  // the surface has recovered; no force changes
    contact.pass(function, indentation);
    return;
  }
  Transition event{time, function.kind, {}, indentation};
  if (function.contact > 0) {
    event.kind = function.kind == EventKind::contact_begins ? EventKind::support_touches
                                                            : EventKind::support_lifts;
    event.spring = beam_.supports()[function.contact - 1].spring;
  }
  if (changes_branch) check_root(function, time, y);
  watch_for_chattering(function.contact, time);
  const bool audited = observer_.audits_events() && function.contact == 0;
  if (!audited) audit_.check(time, y);
  ++n_events_;
  losses_.forget_neighbours();
  observer_.before_event(event, y, beam_);
  if (changes_branch) {
    beam_.commit(y);
    contact.pass(function, indentation);
  } else {
    contact.set(branch_after(function.kind), contact.history());
  }
  const bool touches = function.kind == EventKind::contact_begins && !function.of_rate();
  if (touches) contact.touch(beam_.indentation_rate(y, function.contact));
  if (!audited) audit_.check(time, y);
  observer_.after_event(event, y, beam_);
}

void EventLoop::check_root(const EventFunction& function, double time, const State& y) {
  beam_.set_time(time);
  const EventValue at = beam_.evaluate(function, y);
  double tolerated = tolerated_rounding * rounding_of(function, beam_, y, time, at);
  if (const auto root = integrator_.root()) tolerated += std::abs(at.rate) * root->tolerance;
  if (!(std::abs(at.value) <= tolerated)) {
    audit_.fail(time, OutcomeKind::inaccurate,
                "{} was located at {}, but its condition is missed there by {:.2e} {}, "
                "tolerated are {:.1e}",
                to_string(function.kind), instant_text(time), at.value,
                function.of_rate() ? "m/s" : "m", tolerated);
  }
  if (!(time >= last_event_)) {
    audit_.fail(time, OutcomeKind::inaccurate,
                "{} was located at {}, before the event that precedes it", to_string(function.kind),
                instant_text(time));
  }
  Watch& watch = watches_[function.contact];
  if (function.kind == EventKind::contact_begins) watch.contact_start = time;
  if (function.contact == 0 && function.kind == EventKind::contact_ends &&
      !(time > watch.contact_start)) {
    audit_.fail(time, OutcomeKind::inaccurate,
                "the contact that begins at {} ends at the same instant", instant_text(time));
  }
  last_event_ = time;
}

void EventLoop::watch_for_chattering(std::size_t contact, double time) {
  Watch& watch = watches_[contact];
  if (time - watch.events_since > options_.shortest_contact) {
    watch.events_since = time;
    watch.n_in_place = 0;
  }
  if (++watch.n_in_place <= most_events_in_place) return;
  audit_.fail(time, OutcomeKind::chattering, "{} changed its state {} times within {:.2e} us",
              contact == 0 ? "the contact" : "a support that lifts", watch.n_in_place,
              us * (time - watch.events_since));
}

void EventLoop::interpolate_events() {
  const StepEnds step = step_to_end_time();
  interpolated_.clear();
  for (std::size_t i = 0; i < beam_.n_contacts(); ++i) {
    const ContactState& contact = beam_.contact(i);
    const IndentationStep whole =
        i == 0 ? indentation_of(step)
               : indentation_step(beam_, i, step.t0, step.t1, step.y0, step.y1);
    const ContactBranch after = contact.law().branch(contact.history(), whole.lambda1);
    if (after == contact.branch()) continue;
    if (i > 0 && std::abs(whole.lambda1) <= beam_.dead_length(step.y1, i)) continue;
    subimpact::interpolate_events(contact, i, whole, after, interpolated_);
  }
  std::ranges::stable_sort(interpolated_, {}, &InterpolatedEvent::time);
  double t0 = step.t0;
  const State* y0 = &step.y0;
  bool from_end = false;
  for (const auto& [function, time] : interpolated_) {
    // Forces act at the ends of steps: before contact begins the motion is that of the step's
    // start, after it ends that of the step's end, both without the contact force.
    from_end = function.kind == EventKind::contact_ends;
    piece_start_ = *y0;
    const StepEnds piece{t0, time, piece_start_, event_state_};
    if (from_end) {
      integrator_.state_before_end(time, event_state_);
    } else {
      integrator_.state_at(time, event_state_);
    }
    show_piece(piece);
    report(function, time, event_state_, false);
    t0 = time;
    y0 = &event_state_;
  }
  for (const auto& [function, time] : interpolated_) {
    beam_.contact(function.contact).follow(beam_.indentation(step.y1, function.contact));
  }
  show_piece({t0, step.t1, *y0, step.y1}, from_end);
  const bool is_evaluated_last =
      integrator_.ends_at_last_evaluation() && beam_.n_accelerations() == evaluations_at_end_;
  if (is_evaluated_last) {
    beam_.commit_evaluated(step.y1);
  } else {
    beam_.commit(step.y1);
  }
  time_ = step.t1;
  state_ = &step.y1;
  if (!pass_corner(time_, *state_)) return;
  integrator_.restart(time_, *state_);
  state_ = &integrator_.state();
  read_indentation();
}

}  // namespace subimpact
