#include <fmt/format.h>

#include "subimpact/simulate/result.h"

namespace subimpact {
std::string Result::brief_report() const {
  return fmt::format("{} at {:.6g} s: {} sub-impacts, energy error {:.1e}, {} steps, {:.3g} s",
                     to_string(outcome.kind), outcome.time, sub_impacts.size(), max_energy_error,
                     work.steps, work.wall_seconds);
}

std::string_view to_string(OutcomeKind kind) {
  static constexpr std::string_view names[] = {"completed",    "stopped",    "inaccurate",
                                               "unstable",     "chattering", "solver-failed",
                                               "left-validity"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view to_string(NearMissKind kind) {
  return kind == NearMissKind::opening ? "opening" : "closing";
}

void assign_zones(std::vector<SubImpact>& sub_impacts, double zone_gap, double subzone_gap) {
  int zone = 0;
  int subzone = 0;
  const SubImpact* previous = nullptr;
  for (SubImpact& here : sub_impacts) {
    const double gap = previous && previous->end ? here.start - *previous->end : 0.0;
    if (!previous || gap >= zone_gap) {
      ++zone;
      subzone = 1;
    } else if (gap >= subzone_gap) {
      ++subzone;
    }
    here.zone = zone;
    here.subzone = subzone;
    previous = &here;
  }
}

}  // namespace subimpact
