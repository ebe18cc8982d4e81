#include "subimpact/system/events.h"

namespace subimpact {

std::string_view to_string(EventKind kind) {
  switch (kind) {
    case EventKind::contact_begins:
      return "contact_begins";
    case EventKind::contact_yields:
      return "contact_yields";
    case EventKind::contact_unloads:
      return "contact_unloads";
    case EventKind::contact_ends:
      return "contact_ends";
    case EventKind::section_reverses:
      return "section_reverses";
  }
  return "unknown";
}

}  // namespace subimpact
