#include "subimpact/system/events.h"

namespace subimpact {

std::string_view to_string(EventKind kind) {
  static constexpr std::string_view names[] = {
      "contact_begins", "contact_yields", "contact_unloads", "contact_ends", "section_reverses"};
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace subimpact
