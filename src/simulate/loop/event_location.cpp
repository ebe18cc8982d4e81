#include "simulate/loop/event_location.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/bracketed_root.h"
#include "simulate/loop/audit.h"

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
double to_rounding(double time) { return 8.0 * epsilon * time; }

}  // namespace

double rounding_of(const EventFunction& function, const StruckBeam& beam, const State& y, double t,
                   const EventValue& at) {
  const double of_value = function.of_rate()     ? velocity_rounding * beam.scales().velocity
                          : function.contact > 0 ? beam.dead_length(y, function.contact)
                                                 : std::max(beam.displacement_rounding(y),
                                                            epsilon * beam.scales().position);
  return of_value + epsilon * t * std::abs(at.rate);
}

std::optional<Crossing> EventLocator::find_crossing_in(const IndentationStep& ends, const State& y0,
                                                       const State& y1) {
  std::optional<Crossing> earliest;
  for (std::size_t i = 0; i < beam_.n_contacts(); ++i) {
    const IndentationStep own =
        i == 0 ? ends : indentation_step(beam_, i, ends.t0, ends.t1, y0, y1);
    // A double root needs an indentation that reverses.
    const bool double_roots = double_roots_ && (own.rate0 > 0.0) != (own.rate1 > 0.0);
    const double dead_length = beam_.dead_length(y1, i);
    const double rounding = i > 0          ? dead_length
                            : double_roots ? beam_.displacement_rounding(y1)
                                           : 0.0;
    auto found =
        find_crossing(beam_.contact(i), own, {dealt_with_, double_roots, rounding, i, dead_length});
    if (found && !(earliest && earliest->guess <= found->guess)) earliest = found;
  }
  return earliest;
}

FoundEnd EventLocator::find_end(const StepEnds& whole, const IndentationStep& indentation) {
  FoundEnd end{whole.t1, &whole.y1};
  for (int n_cuts = 0; n_cuts < most_cuts; ++n_cuts) {
    if (events_ == EventHandling::located) end = find_event(whole, indentation, end);
    if (events_ == EventHandling::library && n_cuts == 0) end = event_of_integrator(whole, end);
    corrector_.correct({whole.t0, end.t, whole.y0, *end.y, whole.event_free}, correction_);
    if (!(correction_.valid_until < end.t)) {
      if (correction_.is_empty()) return end;
      if (!end.event) end.event = event_of_correction(indentation, whole.y0, end);
      if (!end.event) return end;
      const std::optional<double> time =
          relocate(*end.event, {whole.t0, end.t, whole.y0, *end.y}, whole.t1);
      return time ? FoundEnd{*time, &end_, end.event} : FoundEnd{end.t, end.y};
    }
    end = {correction_.valid_until, &end_};
    integrator_.state_at(end.t, end_);
  }
  throw RunStopped(OutcomeKind::solver_failed,
                   "section events cut one step over and over, without an end");
}

FoundEnd EventLocator::find_event(const StepEnds& whole, IndentationStep ends, FoundEnd end) {
  dealt_with_.clear();
  if (whole.event_free) return end;
  const auto cut = [&] {
    ends.t1 = end.t;
    ends.lambda1 = beam_.indentation(*end.y);
    ends.rate1 = beam_.indentation_rate(*end.y);
  };
  if (end.t < ends.t1) cut();
  while (auto crossing = find_crossing_in(ends, whole.y0, *end.y)) {
    const StepEnds step{whole.t0, end.t, whole.y0, *end.y};
    dealt_with_.push_back(crossing->function);
    if (crossing->unresolved && !resolve(*crossing, step)) continue;
    end = {locate(*crossing, step), &end_, crossing->function};
    std::swap(end_, trial_);
    cut();
  }
  return end;
}

std::optional<EventFunction> EventLocator::event_of_correction(IndentationStep ends,
                                                               const State& y0,
                                                               const FoundEnd& end) {
  if (events_ != EventHandling::located) return std::nullopt;
  trial_ = *end.y;
  correction_.add_to(trial_);
  ends.t1 = end.t;
  ends.lambda1 = beam_.indentation(trial_);
  ends.rate1 = beam_.indentation_rate(trial_);
  const std::optional<Crossing> crossing = find_crossing_in(ends, y0, trial_);
  if (!crossing || !(beam_.evaluate(crossing->function, trial_).value > 0.0)) return std::nullopt;
  return crossing->function;
}

FoundEnd EventLocator::event_of_integrator(const StepEnds& whole, FoundEnd end) {
  const auto root = integrator_.root();
  if (!root || whole.t1 < integrator_.time()) return end;
  end_ = whole.y1;
  return {end.t, &end_, ContactEventFunctions::function_of(beam_, root->function)};
}

bool EventLocator::resolve(Crossing& crossing, const StepEnds& step) {
  // The event function is largest where the indentation reverses: from growing, or from falling for
  // the end of contact.
  const double sense = crossing.function.kind == EventKind::contact_ends ? -1.0 : 1.0;
  const double top = find_rise(
      [&](double t) {
        integrator_.state_at(t, trial_);
        beam_.set_time(t);
        EventFunction reversal(EventKind::contact_unloads);
        reversal.contact = crossing.function.contact;
        const EventValue at = beam_.evaluate(reversal, trial_);
        return EventValue{sense * at.value, sense * at.rate};
      },
      step.t0, step.t1, crossing.guess, to_rounding(step.t1));
  const double height = beam_.evaluate(crossing.function, trial_).value;
  const std::size_t contact = crossing.function.contact;
  if (!(height > std::max(beam_.displacement_rounding(trial_, contact),
                          beam_.dead_length(trial_, contact)))) {
    return false;
  }
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

std::optional<double> EventLocator::relocate(const EventFunction& function, const StepEnds& step,
                                             double latest) {
  const double tolerance = to_rounding(step.t1);
  // The state at t without the correction is left in end_.
  const auto value_at = [&](double t) {
    integrator_.state_at(t, end_);
    corrector_.correct({step.t0, t, step.y0, end_}, correction_);
    trial_ = end_;
    correction_.add_to(trial_);
    beam_.set_time(t);
    return beam_.evaluate(function, trial_);
  };
  // The method's own state: a root of the library lies on the library's dense output.
  const EventValue here = value_at(step.t1);
  if (std::abs(here.value) <= rounding_of(function, beam_, trial_, step.t1, here)) return step.t1;
  const double guess = step.t1 - here.value / here.rate;
  if (here.value > 0.0) {
    return find_rise(value_at, step.t0, step.t1, guess, tolerance);
  }
  // The zero is not reached yet: search a little later if the function certainly rises fast enough.
  const double ahead = std::min(step.t1 - 2.0 * here.value / here.rate, latest);
  if (here.rate > 0.0 && ahead > step.t1 && value_at(ahead).value > 0.0) {
    return find_rise(value_at, step.t1, ahead, guess, tolerance);
  }
  value_at(step.t1);
  return std::nullopt;
}

}  // namespace subimpact
