#include <fmt/format.h>

#include "subimpact/simulate/result.h"

namespace subimpact {
std::string Result::brief_report() const {
  return fmt::format("{} at {:.6g} s: {} sub-impacts, energy error {:.1e}, {} steps, {:.3g} s",
                     to_string(outcome.kind), outcome.time, sub_impacts.size(), max_energy_error,
                     work.steps, work.wall_seconds);
}

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
