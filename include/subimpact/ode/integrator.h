#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "subimpact/ode/second_order_ode.h"
#include "subimpact/ode/work_counts.h"

namespace subimpact {

/// Thrown by an integrator that cannot continue; the parts of `what()` are stored for reports.
class IntegrationFailure : public std::runtime_error {
 public:
  IntegrationFailure(double time, const std::string& function, const std::string& flag,
                     const std::string& detail)
      : std::runtime_error(function + " failed with " + flag +
                           (detail.empty() ? "" : ": " + detail)),
        time(time),
        function(function),
        flag(flag) {}
  double time;           ///< s, up to which the solution is good
  std::string function;  ///< library function or own routine
  std::string flag;      ///< name of the error
};

/// Integrates q'' = a(q), or a(q, v), over an interval in which a is smooth, with one method.
/// Integrators contain nothing about beams or events: the caller examines each step, may request
/// the state at any time inside the step, and restarts after an event.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Begins, or begins again after an event, at (t, y). The acceleration may have changed.
  virtual void restart(double t, const State& y) = 0;
  /// After a restart: the next step is at most this long (s), for methods that would begin with the
  /// length of the step before, where the forces have become stiffer.
  virtual void limit_next_step(double /*longest*/) {}

  /// Takes one accepted step from time() on. May pass any event: the acceleration is then that of
  /// the branch in force, continued. Throws IntegrationFailure; time() and state() are then still
  /// those of the last accepted step.
  virtual void step() = 0;

  // The last step's ends; both are the present state before the first step after a restart.
  double start_time() const { return t0_; }
  double time() const { return t1_; }
  const State& start_state() const { return y0_; }
  const State& state() const { return y1_; }

  /// The state at a time within the last step, with the method's own accuracy (a partial step from
  /// the start, not an interpolant of lower order).
  virtual void state_at(double t, State& y) = 0;

  /// The same, integrated backwards from the end of the step. The result differs from state_at by
  /// the step's own error, which is large only where the force changes within the step.
  virtual void state_before_end(double t, State& y) { state_at(t, y); }

  /// A hint: state_at() will be called for these times (s, ascending) within the last step, of
  /// which some methods compute several at once.
  virtual void expect(std::span<const double> /*times*/) {}

  /// A root at the end of the last step, which the integrator's own root-finding ended there.
  struct Root {
    std::size_t function;  ///< of the event functions that the integrator was given
    double tolerance;      ///< s, of its time
  };
  /// Nothing for integrators without root-finding. After a root the caller restarts.
  virtual std::optional<Root> root() const { return std::nullopt; }

  /// Whether the integrator has proven that no event happened in the last step, however long:
  /// events need not be looked for in it.
  virtual bool is_event_free() const { return false; }
  /// Two times (s) within such a step between which the last event function has its largest value,
  /// or its smallest; nothing after other steps.
  virtual std::optional<std::pair<double, double>> around_largest() const { return std::nullopt; }
  virtual std::optional<std::pair<double, double>> around_smallest() const { return std::nullopt; }

  /// The integral of the square of each velocity from the start of the last step to t, where the
  /// method has it in closed form; returns false where the method has none.
  virtual bool integrate_squared_velocities(double /*t*/, std::span<double> /*result*/) {
    return false;
  }

  /// Whether the acceleration that step() computes last is that at state().
  virtual bool ends_at_last_evaluation() const { return false; }

  virtual WorkCounts work() const { return work_; }

 protected:
  /// Before the first step: both ends of the last one.
  void stand_at(double t, const State& y) {
    t0_ = t1_ = t;
    y0_ = y;
    y1_ = y;
  }
  /// For a step that failed after its start became (t0_, y0_): back to that start.
  void undo_step() {
    t1_ = t0_;
    y1_ = y0_;
  }

  double t0_ = 0.0, t1_ = 0.0;
  State y0_, y1_;
  WorkCounts work_;  // as far as the method counts them itself
};

/// How far a run wants an integrator to go in one step.
struct StepControl {
  double rtol;                           ///< of methods with error control, relative to the scales
  std::optional<double> step, max_step;  ///< s
  double critical_step;                  ///< s, of central differences
};

/// An integrator of the caller's own (solver.method "own"): it goes through events, errors and
/// comparisons as the built-in ones do. No case file can contain it.
struct OwnIntegrator {
  /// Called at the start of each run, also of several threads at once. The ODE outlives the result.
  std::function<std::unique_ptr<Integrator>(SecondOrderOde& ode, const StepControl& control)> make;
  int order = 0;                  ///< of event times at fixed steps, for tables; 0: not known
  bool is_adaptive = false;       ///< whether it controls its error where no step is given
  bool takes_velocities = false;  ///< whether it integrates a(q, v), by acceleration_at()
};

}  // namespace subimpact
