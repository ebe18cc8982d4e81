#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace subimpact {

/// Events, at which the equations of motion change.
enum class EventKind {
  contact_begins,    ///< the gap closes: indentation rises through the residual one
  contact_yields,    ///< the indentation rises through its largest value so far (or first yield)
  contact_unloads,   ///< the indentation stops growing while the contact flows
  contact_ends,      ///< the force falls to zero
  section_reverses,  ///< a flowing section reverses
};

/// The name used in transitions.csv.
std::string_view to_string(EventKind kind);

/// One located event. `value` is the indentation (m) for events of the contact, the curvature (1/m)
/// for those of a section; `section` is its index from the first end, or none.
struct Transition {
  double time = 0.0;  ///< s
  EventKind kind = EventKind::contact_begins;
  std::optional<std::size_t> section;
  double value = 0.0;
};

}  // namespace subimpact
