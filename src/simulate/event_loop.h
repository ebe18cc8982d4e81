#pragma once

#include <limits>
#include <vector>

#include "ode/integrator.h"
#include "simulate/audit.h"
#include "subimpact/simulate/options.h"
#include "system/struck_beam.h"

namespace subimpact {

/// Watches a run from inside; this one does not look. Observers of users see less: see Observer and
/// Observers. All states handed over are accepted ones, but for the
/// ends of steps.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  /// A step ends at `step.t1`, before its end is put right and committed: the equations are still
  /// those of the step, so the integrator may be asked for the state at any time within it. Where
  /// events are interpolated, a step with events is shown in pieces, from event to event.
  virtual void on_step(const StepEnds& /*step*/, StruckBeam& /*beam*/, Integrator& /*integrator*/) {
  }
  /// The state that the loop has accepted as the end of the step, its event applied.
  virtual void on_accepted(double /*time*/, const State& /*y*/, StruckBeam& /*beam*/) {}
  /// A section turned back within the step last seen.
  virtual void on_turn(const Transition& /*turn*/) {}
  /// An event, once with the equations before it and once with those after it.
  virtual void before_event(const Transition& /*event*/, const State& /*y*/, StruckBeam& /*beam*/) {
  }
  virtual void after_event(const Transition& /*event*/, const State& /*y*/, StruckBeam& /*beam*/) {}
  /// Whether the observer itself has both sides of every event audited, so that the loop need not.
  virtual bool audits_events() const { return false; }
};

struct LoopOptions {
  double end_time = 0.0;  ///< s
  EventHandling events = EventHandling::located;
  /// How well what sections do within a step is put right at its end (m/s, see
  /// StruckBeam::find_section_kinks); infinite: not at all, their memory advances at step ends
  /// only.
  double kink_tolerance = std::numeric_limits<double>::infinity();
  double largest_indentation = 0.0;  ///< m; beyond it the contact law means nothing
  /// Steps between two full checks of energy and momentum; events and history rows are checked too.
  long audit_interval = 32;
  /// s: the shortest time that a contact takes. Many more events than fit into it are chattering.
  double shortest_contact = 0.0;
};

/// The one loop all methods share: step, find what happened in the step, end it there, switch, go
/// on.
class EventLoop {
 public:
  EventLoop(StruckBeam& beam, Integrator& integrator, RunObserver& observer, Audit& audit,
            LoopOptions options);

  /// Puts the beam at t = 0 with the contact just begun.
  void start();
  /// Puts the beam at t = 0 in another state, with the contact as it is (see set_contact).
  void start_from(const State& y);
  /// One step, to its end, to the first event in it or to the end time. Throws IntegrationFailure
  /// or RunStopped; time() and state() are then those of the last state that was accepted.
  void advance();

  /// After advance() found the energy too high: whether it grows without bound in the steps that
  /// follow. Nothing of these is observed; the loop cannot go on afterwards.
  bool energy_keeps_growing();

  bool finished() const { return time_ >= options_.end_time; }
  double time() const { return time_; }
  const State& state() const { return *state_; }
  long n_events() const { return n_events_; }

 private:
  // The last step, cut short where it passes the end time.
  StepEnds step_to_end_time();
  void locate_events();
  struct Interpolated {
    EventKind kind;
    double time;
  };
  // Events of a step that ends on the branch `after`, in their order.
  std::vector<Interpolated> events_within(const StepEnds& step, ContactBranch after);
  void interpolate_events();
  void put_sections_right(const State*& y);
  // The instant of a crossing, its state in trial_state_.
  double locate(const Crossing& crossing, const StepEnds& step);
  // Moves an event found at step.t1, with step.y1 in event_state_, to where the state with the
  // kinks of sections added meets its guard; false if that is not before `latest`: the step then
  // has no event.
  bool relocate(const Guard& guard, const StepEnds& step, double latest, double& time);
  // Whether a doubtful crossing happens; if so, narrows it to the time before the hump's top.
  bool confirm(Crossing& crossing, const StepEnds& step);
  void report(const Guard& guard, double time, const State& y, bool switch_branch);
  // What rounding may make of the guard's value at a state that meets it.
  double rounding_of(const Guard& guard, const State& y, double time, const GuardValue& at) const;
  static ContactBranch branch_after(EventKind kind);
  // Throws RunStopped unless the state meets the guard at this time, from the right side.
  void check_root(const Guard& guard, double time, const State& y);
  void watch_for_chattering(double time);
  // Of every step's end, before anything is looked for in the step.
  void check_step_end(const State& y);
  // Of the state accepted at the step's end, at every audit_interval-th step and where told to.
  void check_accepted(bool now);

  StruckBeam& beam_;
  Integrator& integrator_;
  RunObserver* observer_;
  Audit* audit_;
  LoopOptions options_;
  double time_ = 0.0;
  const State* state_ = nullptr;
  State end_state_, event_state_, trial_state_;
  GuardList dealt_with_;           // in the step being looked at
  std::vector<Transition> turns_;  // in it, in their order
  double last_event_ = 0.0;
  double contact_start_ = 0.0;
  double events_since_ = 0.0;  // s: of the events counted by n_events_in_place_
  long n_events_in_place_ = 0;
  long n_events_ = 0;
  long n_steps_ = 0;
};

}  // namespace subimpact
