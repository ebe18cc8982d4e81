#pragma once

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <optional>
#include <vector>

#include "subimpact/system/readings.h"

namespace subimpact {

class ObservedStep;
class StruckBeam;

/// Called at intervals with the simulated time, s; for progress displays. Returning false ends the
/// run as at its end time, but with the outcome `stopped`.
using Progress = std::function<bool(double time)>;

/// A point's motion across the beam, positive in the direction of the strike.
struct PointMotion {
  double displacement;  ///< m
  double velocity;      ///< m/s
};

/// Striker and beam at one instant of a run. Valid only during the call that receives it.
class RunView {
 public:
  RunView(double time, const std::vector<double>& state, const StruckBeam& beam)
      : time_(time), state_(state), beam_(beam) {}

  double time() const { return time_; }  ///< s
  PointMotion striker() const;
  PointMotion struck_point() const;  ///< of the beam's axis under the striker
  bool in_contact() const;
  double indentation() const;           ///< lambda, m: striker less struck point; negative: a gap
  double residual_indentation() const;  ///< lambda_r, m
  double contact_force() const;         ///< F, N, on the beam in the direction of the strike
  /// Curvature, 1/m, of the section nearest to x (m, within the part modelled). The strain of the
  /// outer fibre behind is -curvature h/2.
  double curvature(double x) const;
  /// Displacement of the axis at x, m; nothing on a mesh without displacement_at().
  std::optional<double> displacement(double x) const;
  /// U_m to D_c, J. Costs about as much as one evaluation of the equations of motion.
  Energies energies() const;

 private:
  double time_;
  const std::vector<double>& state_;
  const StruckBeam& beam_;
};

/// An accepted step, or the part of one up to an event, before its end is: the motion within it.
/// Valid only during the call that receives it.
class StepView {
 public:
  StepView(const ObservedStep& step, const StruckBeam& beam, std::vector<double>& state)
      : step_(step), beam_(beam), state_(state) {}

  double start() const;  ///< s
  double end() const;    ///< s
  /// Striker and beam at a time (s) of the step, computed by the method itself, not interpolated;
  /// valid until the next call. Energies are those of the histories at the step's start.
  RunView at(double time) const;

 private:
  const ObservedStep& step_;
  const StruckBeam& beam_;
  std::vector<double>& state_;
};

/// Watches a run: derive from this class, override the functions of interest, and pass the object
/// to simulate().
///
///     struct LargestForce final : subimpact::Observer {
///       void on_step(const subimpact::RunView& now) override {
///         largest = std::max(largest, now.contact_force());
///       }
///       double largest = 0.0;
///     };
/// The calls come in the order of time, in the thread that runs simulate(), with states that the
/// run has accepted. If the run ends as `inaccurate` or `unstable`, states are valid up to
/// Outcome::first_failure; otherwise all are valid. A run without an observer has no overhead from
/// this interface. An exception that leaves an observer ends the run and leaves simulate(); to end
/// a run with results, let goes_on() or the progress function return false.
class Observer {
 public:
  virtual ~Observer() = default;

  /// Called for every step before on_step, for states within it.
  virtual void within_step(const StepView& /*step*/) {}
  /// Called at the end of every accepted step. Steps also end at events: on_step is then called
  /// after after_event, with the same state.
  virtual void on_step(const RunView& /*end*/) {}

  /// Called at an event of the contact, once with the equations of motion before it and once with
  /// those after it; the state is the same. The first touch is such an event; no call precedes it.
  /// With interpolated events (solver.events) both calls come before the end of the step with the
  /// event.
  virtual void before_event(const Transition& /*event*/, const RunView& /*at*/) {}
  virtual void after_event(const Transition& /*event*/, const RunView& /*at*/) {}

  /// Called for a flowing section that reversed within the step that ends next.
  virtual void on_reversal(const Transition& /*reversal*/) {}
  /// Called after every step; false ends the run with the outcome `stopped`.
  virtual bool goes_on() const { return true; }
};

/// Several observers of one run, called in their order; each may end the run.
class Observers final : public Observer {
 public:
  Observers(std::initializer_list<Observer*> all) : all_(all) {}
  void on_step(const RunView& end) override {
    for (Observer* one : all_) one->on_step(end);
  }
  void within_step(const StepView& step) override {
    for (Observer* one : all_) one->within_step(step);
  }
  void before_event(const Transition& event, const RunView& at) override {
    for (Observer* one : all_) one->before_event(event, at);
  }
  void after_event(const Transition& event, const RunView& at) override {
    for (Observer* one : all_) one->after_event(event, at);
  }
  void on_reversal(const Transition& reversal) override {
    for (Observer* one : all_) one->on_reversal(reversal);
  }
  bool goes_on() const override {
    return std::ranges::all_of(all_, [](const Observer* one) { return one->goes_on(); });
  }

 private:
  std::vector<Observer*> all_;
};

}  // namespace subimpact
