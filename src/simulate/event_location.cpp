#include "simulate/event_location.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "numerics/bracketed_root.h"
#include "simulate/audit.h"

namespace subimpact {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// Rounding of the velocity at which the contact closes, as part of the striker's: it is the
// difference of two velocities, each a sum over the stages of a step.
constexpr double velocity_rounding = 1e-12;
// Section events cut a step a few times at most, where the tolerance can be met at all: at most
// twice in the 1e6 steps of validation/, three times in 40 random scenes and in the example of the
// paper at rtol 1e-2 to 1e-8. Where a step is cut over and over, the search does not end.
constexpr int most_cuts = 100;

// Roots are found to rounding.
RootOptions to_rounding(double time) { return {8.0 * epsilon * time}; }

}  // namespace

double rounding_of(const EventFunction& function, const StruckBeam& beam, const State& y, double t,
                   const EventValue& at) {
  const double of_value = function.kind == EventKind::contact_unloads || function.by_rate
                              ? velocity_rounding * beam.scales().velocity
                              : beam.displacement_rounding(y);
  return of_value + epsilon * t * std::abs(at.rate);
}

std::optional<Crossing> EventLocator::find_crossing_in(const IndentationStep& ends,
                                                       const State& y1) {
  // A double root needs an indentation that reverses.
  const bool double_roots = double_roots_ && (ends.rate0 > 0.0) != (ends.rate1 > 0.0);
  const double rounding = double_roots ? beam_.displacement_rounding(y1) : 0.0;
  return find_crossing(beam_.contact(), ends, {dealt_with_, double_roots, rounding});
}

std::optional<EventFunction> EventLocator::find_end(const StepEnds& whole,
                                                    const IndentationStep& indentation, double& t1,
                                                    const State*& y1,
                                                    SectionCorrection& correction) {
  const State& y0 = whole.y0;
  const double t0 = whole.t0;
  t1 = whole.t1;
  y1 = &whole.y1;
  for (int n_cuts = 0; n_cuts < most_cuts; ++n_cuts) {
    std::optional<EventFunction> event;
    if (events_ == EventHandling::located) event = find_event(whole, indentation, t1, y1);
    if (events_ == EventHandling::library && n_cuts == 0) event = event_of_integrator(whole, y1);
    corrector_.correct({t0, t1, y0, *y1, whole.event_free}, correction);
    if (!(correction.valid_until < t1)) {
      if (correction.is_empty()) return event;
      if (!event) event = event_of_correction(indentation, t1, *y1, correction);
      if (!event) return std::nullopt;
      if (!relocate(*event, {t0, t1, y0, *y1}, whole.t1, t1, correction)) return std::nullopt;
      y1 = &end_;
      return event;
    }
    t1 = correction.valid_until;
    integrator_.state_at(t1, end_);
    y1 = &end_;
  }
  throw RunStopped(OutcomeKind::solver_failed,
                   "section events cut one step over and over, without an end");
}

std::optional<EventFunction> EventLocator::find_event(const StepEnds& whole, IndentationStep ends,
                                                      double& t1, const State*& y1) {
  dealt_with_.clear();
  if (whole.event_free) return std::nullopt;
  const auto cut = [&] {
    ends = {
        ends.t0, t1, ends.lambda0, ends.rate0, beam_.indentation(*y1), beam_.indentation_rate(*y1)};
  };
  if (t1 < ends.t1) cut();
  std::optional<EventFunction> event;
  while (auto crossing = find_crossing_in(ends, *y1)) {
    const StepEnds step{whole.t0, t1, whole.y0, *y1};
    dealt_with_.push_back(crossing->function);
    if (crossing->unresolved && !resolve(*crossing, step)) continue;
    t1 = locate(*crossing, step);
    std::swap(end_, trial_);
    y1 = &end_;
    event = crossing->function;
    cut();
  }
  return event;
}

std::optional<EventFunction> EventLocator::event_of_correction(
    IndentationStep ends, double t1, const State& y1, const SectionCorrection& correction) {
  if (events_ != EventHandling::located) return std::nullopt;
  trial_ = y1;
  correction.add_to(trial_);
  ends.t1 = t1;
  ends.lambda1 = beam_.indentation(trial_);
  ends.rate1 = beam_.indentation_rate(trial_);
  const std::optional<Crossing> crossing = find_crossing_in(ends, trial_);
  if (!crossing || !(beam_.evaluate(crossing->function, trial_).value > 0.0)) return std::nullopt;
  return crossing->function;
}

std::optional<EventFunction> EventLocator::event_of_integrator(const StepEnds& whole,
                                                               const State*& y1) {
  const auto root = integrator_.root();
  if (!root || whole.t1 < integrator_.time()) return std::nullopt;
  end_ = whole.y1;
  y1 = &end_;
  return beam_.contact().event_functions()[root->function];
}

bool EventLocator::resolve(Crossing& crossing, const StepEnds& step) {
  // The event function is largest where the indentation reverses: from growing, or from falling for
  // the end of contact.
  const double sense = crossing.function.kind == EventKind::contact_ends ? -1.0 : 1.0;
  const EventFunction reversal{EventKind::contact_unloads, sense};
  const double top = find_rise(
      [&](double t) {
        integrator_.state_at(t, trial_);
        beam_.set_time(t);
        return beam_.evaluate(reversal, trial_);
      },
      step.t0, step.t1, crossing.guess, to_rounding(step.t1));
  const double height = beam_.evaluate(crossing.function, trial_).value;
  if (!(height > beam_.displacement_rounding(trial_))) return false;
  crossing.t_upper = top;
  crossing.guess = 0.5 * (crossing.t_lower + top);
  return true;
}

double EventLocator::locate(const Crossing& crossing, const StepEnds& step) {
  if (!(crossing.t_upper > step.t0)) {  // it happened at the start
    trial_ = step.y0;
    return step.t0;
  }
  const auto value_at = [&](double t) {
    integrator_.state_at(t, trial_);
    beam_.set_time(t);
    return beam_.evaluate(crossing.function, trial_);
  };
  double lower = crossing.t_lower;
  double upper = crossing.t_upper;
  double guess = crossing.guess;
  // The cubic of a step that blew up has no extremum that is a number.
  if (!(lower <= upper)) {
    lower = step.t0;
    upper = step.t1;
  }
  // Where the cubic has its lowest point the function may already have risen again.
  if (lower > step.t0 && value_at(lower).value > 0.0) {
    upper = lower;
    lower = step.t0;
    guess = 0.5 * (lower + upper);
  }
  return find_rise(value_at, lower, upper, guess, to_rounding(step.t1));
}

bool EventLocator::relocate(const EventFunction& function, const StepEnds& step, double latest,
                            double& time, SectionCorrection& correction) {
  const RootOptions options = to_rounding(step.t1);
  // The state at t without the correction is left in end_.
  const auto value_at = [&](double t) {
    integrator_.state_at(t, end_);
    corrector_.correct({step.t0, t, step.y0, end_}, correction);
    trial_ = end_;
    correction.add_to(trial_);
    beam_.set_time(t);
    return beam_.evaluate(function, trial_);
  };
  // The method's own state: a root of the library lies on the library's dense output.
  const EventValue here = value_at(step.t1);
  if (std::abs(here.value) <= rounding_of(function, beam_, trial_, step.t1, here)) return true;
  const double guess = step.t1 - here.value / here.rate;
  if (here.value > 0.0) {
    time = find_rise(value_at, step.t0, step.t1, guess, options);
    return true;
  }
  // The zero is not reached yet: search a little later if the function certainly rises fast enough.
  const double ahead = std::min(step.t1 - 2.0 * here.value / here.rate, latest);
  if (here.rate > 0.0 && ahead > step.t1 && value_at(ahead).value > 0.0) {
    time = find_rise(value_at, step.t1, ahead, guess, options);
    return true;
  }
  value_at(step.t1);
  return false;
}

}  // namespace subimpact
