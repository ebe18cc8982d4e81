#pragma once

#include <limits>
#include <vector>

#include "ode/integrator.h"
#include "simulate/loop/audit.h"
#include "simulate/loop/event_location.h"
#include "simulate/loop/observed_step.h"
#include "simulate/loop/quadratures.h"
#include "subimpact/simulate/options.h"
#include "system/struck_beam.h"

namespace subimpact {

/// An observer inside the program; the base class ignores all calls. Observers of users receive
/// less (Observer, Observers). All states passed are accepted ones, except the ends of steps.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  /// The striker's approach to the beam, from t = 0 to the first touch at `end` (s).
  virtual void on_approach(double /*end*/, StruckBeam& /*beam*/) {}
  /// A step, before its end is corrected and committed. Where events are interpolated, a step with
  /// events is shown in pieces, from event to event.
  virtual void on_step(const ObservedStep& /*step*/, StruckBeam& /*beam*/) {}
  /// The state that the loop has accepted as the end of the step, its event applied.
  virtual void on_accepted(double /*time*/, const State& /*y*/, StruckBeam& /*beam*/) {}
  /// A section reversed within the step last seen.
  virtual void on_reversal(const Transition& /*reversal*/) {}
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
  /// Tolerance of the section correction (m/s, see SectionCorrector); infinite: no correction,
  /// histories of sections advance at step ends only.
  double correction_tolerance = std::numeric_limits<double>::infinity();
  double largest_indentation = 0.0;  ///< m; the contact law is not valid beyond it
  std::string end_of_law = "the beam's thickness, where the contact law ends";
  std::string remedy = "reduce striker.velocity or striker.mass, or make the contact stiffer";
  /// Steps between two full checks of energy and momentum; events and history rows are checked too.
  long audit_interval = 32;
  /// s: the shortest time that a contact takes. Many more events than fit into it are chattering.
  double shortest_contact = 0.0;
  /// s: the longest first step of a contact.
  double first_step_of_contact = std::numeric_limits<double>::infinity();
  /// Whether a branch of the contact left and regained within one step is looked for.
  bool double_roots = true;
  /// s: when striker and beam first touch. Until then the striker moves uniformly, the beam rests.
  double first_touch = 0.0;
  /// Whether the run begins apart, at t = 0, and looks for the first touch as for any other.
  bool begins_apart = false;
};

/// The loop of all methods: take a step, end it at its first event, change the equations, continue.
class EventLoop {
 public:
  EventLoop(StruckBeam& beam, Integrator& integrator, RunObserver& observer, Audit& audit,
            const LoopOptions& options);

  /// Puts the beam at the first touch, with the contact just begun, or at t = 0 apart.
  void start();
  /// start() in another state, with the contact as it is (see ContactState::set).
  void start_from(const State& y);
  /// One step, to its end, to the first event in it or to the end time. Throws IntegrationFailure
  /// or RunStopped; time() and state() are then those of the last state that was accepted.
  void advance();

  bool finished() const { return time_ >= options_.end_time; }
  double time() const { return time_; }
  const State& state() const { return *state_; }
  long n_events() const { return n_events_; }
  long n_correction_solves() const { return corrector_.n_mass_solves(); }

 private:
  // The last step, cut short where it passes the end time or a corner of a load.
  StepEnds step_to_end_time();
  void locate_events();
  // Where the step has ended at a corner of a load: goes on with the next piece.
  bool pass_corner(double t, const State& y);
  void interpolate_events();
  void show_piece(const StepEnds& piece, bool from_end = false);
  void report_reversals();
  void report(const EventFunction& function, double time, const State& y, bool changes_branch);
  // Events of supports at the instant of another contact's, as symmetry has them.
  void report_simultaneous(const EventFunction& event, double time, const State& y);
  // Throws RunStopped unless the state meets the event function at this time, from the right side.
  void check_root(const EventFunction& function, double time, const State& y);
  void watch_for_chattering(std::size_t contact, double time);
  // Checks the end of every step, before events are searched in the step.
  void check_step_end();
  void read_indentation();
  IndentationStep indentation_of(const StepEnds& piece) const;
  // Checks the state accepted at the step's end, every audit_interval steps and where required.
  void check_accepted(bool now) {
    if (now || finished() || n_steps_ % options_.audit_interval == 0) audit_.check(time_, *state_);
  }

  StruckBeam& beam_;
  Integrator& integrator_;
  RunObserver& observer_;
  Audit& audit_;
  LoopOptions options_;
  double time_ = 0.0;
  const State* state_ = nullptr;
  State end_state_, event_state_, piece_start_;
  IndentationStep indentation_{};  // of the last step as the method took it
  SectionCorrector corrector_;
  EventLocator locator_;
  LossQuadrature losses_;
  std::vector<Transition> reversals_;            // of the step being searched, in their order
  std::vector<InterpolatedEvent> interpolated_;  // of the step
  double last_event_ = 0.0;
  struct Watch {  // over the events of one contact
    double contact_start = 0.0;
    double events_since = 0.0;  // s: of the events counted by n_in_place
    long n_in_place = 0;
  };
  std::vector<Watch> watches_;
  long n_events_ = 0;
  long n_steps_ = 0;
  long evaluations_at_end_ = 0;  // of the acceleration, when the step's end was reached
};

}  // namespace subimpact
