#pragma once

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "integrate/integrator.h"
#include "subimpact/simulate/case.h"
#include "system/struck_beam.h"

namespace subimpact {

/// Watches a run; this one does not look. All states handed over are accepted ones, but for the
/// ends of steps.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  /// A step ends at `step.t1`, before its end is put right and committed: the equations are still
  /// those of the step, so `integrator.state_at` may be asked for any time within it.
  virtual void on_step(const StepEnds& /*step*/, StruckBeam& /*beam*/, Integrator& /*integrator*/) {
  }
  /// A section turned back within the step last seen.
  virtual void on_turn(const Transition& /*turn*/) {}
  /// An event, once with the equations before it and once with those after it.
  virtual void before_event(const Transition& /*event*/, const State& /*y*/, StruckBeam& /*beam*/) {
  }
  virtual void after_event(const Transition& /*event*/, const State& /*y*/, StruckBeam& /*beam*/) {}
};

/// The run has to stop where it is: the state is not to be believed any further.
class RunStopped : public std::runtime_error {
 public:
  enum class Reason { unstable, left_validity };
  RunStopped(Reason reason, const std::string& message)
      : std::runtime_error(message), reason(reason) {}
  Reason reason;
};

struct LoopOptions {
  double end_time = 0.0;  ///< s
  EventHandling events = EventHandling::located;
  /// How well what sections do within a step is put right at its end (m/s, see
  /// StruckBeam::find_section_kinks); infinite: not at all, their memory advances at step ends
  /// only.
  double kink_tolerance = std::numeric_limits<double>::infinity();
  double largest_indentation = 0.0;  ///< m; beyond it the contact law means nothing
};

/// The one loop all methods share: step, find what happened in the step, end it there, switch, go
/// on.
class EventLoop {
 public:
  EventLoop(StruckBeam& beam, Integrator& integrator, RunObserver& observer, LoopOptions options);

  /// Puts the beam at t = 0 with the contact just begun.
  void start();
  /// Puts the beam at t = 0 in another state, with the contact as it is (see set_contact).
  void start_from(const State& y);
  /// One step, to its end, to the first event in it or to the end time. Throws IntegrationFailure
  /// or RunStopped; time() and state() are then those before the step.
  void advance();

  bool finished() const { return time_ >= options_.end_time; }
  double time() const { return time_; }
  const State& state() const { return *state_; }
  long n_events() const { return n_events_; }

 private:
  // The last step, cut short where it passes the end time.
  StepEnds step_to_end_time();
  void locate_events();
  void interpolate_events();
  void put_sections_right(const State*& y);
  // The instant of a crossing, its state in trial_state_.
  double locate(const Crossing& crossing, const StepEnds& step);
  // Whether a doubtful crossing happens; if so, narrows it to the time before the hump's top.
  bool confirm(Crossing& crossing, const StepEnds& step);
  void report(const Guard& guard, double time, const State& y, bool switch_branch);
  void check_state(const State& y);

  StruckBeam& beam_;
  Integrator& integrator_;
  RunObserver& observer_;
  LoopOptions options_;
  double time_ = 0.0;
  const State* state_ = nullptr;
  State end_state_, event_state_, trial_state_;
  GuardList dealt_with_;           // in the step being looked at
  std::vector<Transition> turns_;  // in it, in their order
  double initial_energy_ = 0.0;
  long n_events_ = 0;
  long n_steps_ = 0;
};

}  // namespace subimpact
