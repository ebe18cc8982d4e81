#include "subimpact/simulate/records.h"

namespace subimpact {

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
