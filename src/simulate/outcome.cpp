#include "subimpact/simulate/result.h"

namespace subimpact {

std::string_view to_string(OutcomeKind kind) {
  switch (kind) {
    case OutcomeKind::completed:
      return "completed";
    case OutcomeKind::stopped:
      return "stopped";
    case OutcomeKind::inaccurate:
      return "inaccurate";
    case OutcomeKind::unstable:
      return "unstable";
    case OutcomeKind::chattering:
      return "chattering";
    case OutcomeKind::solver_failed:
      return "solver-failed";
    case OutcomeKind::left_validity:
      return "left-validity";
  }
  return "unknown";
}

}  // namespace subimpact
