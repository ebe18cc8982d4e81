#include "system/contact_event_functions.h"

#include <limits>

namespace subimpact {

void ContactEventFunctions::evaluate(std::span<const double> y,
                                     std::span<EventValue> values) const {
  const ContactState& contact = beam_.contact();
  const double lambda = beam_.indentation(y);
  const double rate = beam_.indentation_rate(y);
  const auto [position, velocity] = beam_.scales();
  auto result = values.begin();
  for (const EventKind kind : event_kinds(contact.branch())) {
    const EventValue at = contact.event_function(kind, lambda, rate);
    if (kind == EventKind::contact_unloads) {  // its rate would need the acceleration
      *result++ = {at.value / velocity, std::numeric_limits<double>::quiet_NaN()};
    } else {
      *result++ = {(at.value - beam_.displacement_rounding(y)) / position,
                   double_roots_ ? at.rate / velocity : std::numeric_limits<double>::quiet_NaN()};
    }
  }
}

}  // namespace subimpact
