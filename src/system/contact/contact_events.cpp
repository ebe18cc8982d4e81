#include "system/contact/contact_events.h"

#include <algorithm>
#include <limits>

#include "numerics/hermite.h"

namespace subimpact {
namespace {

// A cubic through the ends of a step is assumed to have the height of a local maximum between them
// right to this part of the height; a maximum closer to zero is searched on the trajectory.
constexpr double uncertain_share = 0.5;

using MaybeCrossing = std::optional<Crossing>;

// A double root: negative at both ends, with a local maximum near or above zero in between.
MaybeCrossing find_double_root(const EventFunction& function, const IndentationStep& step,
                               const EventValue& g0, const EventValue& g1, double rounding) {
  if (!(g0.rate > 0.0 && g1.rate < 0.0)) return std::nullopt;
  const HermiteCubic path(g0.value, g0.rate, g1.value, g1.rate, step.length());
  const double peak = path.peak();
  const double height = path(peak) - std::max(g0.value, g1.value);
  if (!(path(peak) > rounding - uncertain_share * height)) return std::nullopt;
  return Crossing{function, step.t0, step.t1, step.t0 + peak * step.length(), true};
}

MaybeCrossing find_rise_of(const EventFunction& function, const IndentationStep& step,
                           const EventValue& g0, const EventValue& g1) {
  // Positive from the start on; a support's, with a dead length, may already fall again.
  if (g0.value >= 0.0 && g0.rate > 0.0 && (g1.rate > 0.0 || function.contact > 0)) {
    return Crossing{function, step.t0, step.t0, step.t0, false};
  }
  const HermiteCubic path(g0.value, g0.rate, g1.value, g1.rate, step.length());
  // A function that is still at zero from the event before first falls: its root lies behind its
  // lowest point.
  double lower = 0.0;
  if (g0.rate < 0.0 && g1.rate > 0.0) {
    lower = HermiteCubic(-g0.value, -g0.rate, -g1.value, -g1.rate, step.length()).peak();
  }
  return Crossing{function, step.t0 + lower * step.length(), step.t1,
                  step.t0 + path.rise(lower, 1.0) * step.length(), false};
}

// find_rise() for a function of the indentation's rate.
MaybeCrossing find_rise_of_rate(const EventFunction& function, const IndentationStep& step,
                                const EventValue& g0, const EventValue& g1) {
  if (!(g1.value > 0.0)) return std::nullopt;
  const double guess = g0.value < 0.0 ? g0.value / (g0.value - g1.value) : 0.0;
  return Crossing{function, step.t0, step.t1, step.t0 + guess * step.length(), false};
}

}  // namespace

IndentationStep indentation_step(const StruckBeam& beam, std::size_t contact, double t0, double t1,
                                 std::span<const double> y0, std::span<const double> y1) {
  return {t0,
          t1,
          beam.indentation(y0, contact),
          beam.indentation_rate(y0, contact),
          beam.indentation(y1, contact),
          beam.indentation_rate(y1, contact)};
}

std::optional<Crossing> find_crossing(const ContactState& contact, const IndentationStep& step,
                                      const CrossingSearch& search) {
  std::optional<Crossing> earliest;
  for (EventFunction function : contact.event_functions()) {
    function.contact = search.contact;
    if (std::ranges::find(search.without, function) != search.without.end()) continue;
    const EventValue g0 = contact.event_function(function, step.lambda0, step.rate0);
    const EventValue g1 = contact.event_function(function, step.lambda1, step.rate1);
    std::optional<Crossing> found;
    if (function.of_rate()) {
      found = find_rise_of_rate(function, step, g0, g1);
    } else if (g1.value > search.dead_length) {
      found = find_rise_of(function, step, g0, g1);
    } else if (search.double_roots) {
      found = find_double_root(function, step, g0, g1, search.rounding);
    }
    if (found && !(earliest && earliest->guess <= found->guess)) earliest = found;
  }
  return earliest;
}

void interpolate_events(const ContactState& contact, std::size_t number,
                        const IndentationStep& step, ContactBranch after,
                        std::vector<InterpolatedEvent>& events) {
  const ContactBranch before = contact.branch();
  const auto add = [&](EventFunction function, double s) {
    function.contact = number;
    events.push_back({function, step.t0 + s * step.length()});
  };
  const auto add_rise = [&](EventKind kind) {
    const EventValue g0 = contact.event_function(kind, step.lambda0, step.rate0);
    const EventValue g1 = contact.event_function(kind, step.lambda1, step.rate1);
    add(kind, HermiteCubic(g0.value, g0.rate, g1.value, g1.rate, step.length()).rise(0.0, 1.0));
  };
  if (before == ContactBranch::separated) add_rise(EventKind::contact_begins);
  if (before == ContactBranch::plastic) {
    const bool turns = step.rate0 > 0.0 && step.rate1 < 0.0;
    add(EventKind::contact_unloads, turns ? step.rate0 / (step.rate0 - step.rate1) : 0.0);
  }
  if (after == ContactBranch::plastic) add_rise(EventKind::contact_yields);
  if (after == ContactBranch::separated) add_rise(EventKind::contact_ends);
}

std::size_t ContactEventFunctions::size() const {
  std::size_t n = 0;
  for (std::size_t i = 0; i < beam_.n_contacts(); ++i)
    n += beam_.contact(i).event_functions().size();
  return n;
}

EventFunction ContactEventFunctions::function_of(const StruckBeam& beam, std::size_t number) {
  std::size_t contact = 0;
  while (number >= beam.contact(contact).event_functions().size()) {
    number -= beam.contact(contact++).event_functions().size();
  }
  EventFunction function = beam.contact(contact).event_functions()[number];
  function.contact = contact;
  return function;
}

void ContactEventFunctions::evaluate(std::span<const double> y,
                                     std::span<EventValue> values) const {
  const auto [position, velocity] = beam_.scales();
  auto result = values.begin();
  for (std::size_t i = 0; i < beam_.n_contacts(); ++i) {
    const ContactState& contact = beam_.contact(i);
    const double lambda = beam_.indentation(y, i);
    const double rate = beam_.indentation_rate(y, i);
    const double rounding = i == 0 ? beam_.displacement_rounding(y) : beam_.dead_length(y, i);
    for (const EventFunction& function : contact.event_functions()) {
      const EventValue at = contact.event_function(function, lambda, rate);
      if (function.of_rate()) {  // its rate would need the acceleration
        *result++ = {at.value / velocity, std::numeric_limits<double>::quiet_NaN()};
      } else {
        *result++ = {(at.value - rounding) / position,
                     double_roots_ ? at.rate / velocity : std::numeric_limits<double>::quiet_NaN()};
      }
    }
  }
}

}  // namespace subimpact
