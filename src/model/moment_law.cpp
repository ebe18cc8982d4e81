#include "model/moment_law.h"

namespace subimpact {

// As SectionLaw::branch_at, by moments: an older branch takes over where the motion passes the
// reversal point before the last.
MomentLaw::Branch MomentLaw::branch_to(double m) const {
  const bool turned = history_.direction * (m - history_.edge.m) < 0.0;
  const double sense = turned ? -history_.direction : history_.direction;
  const auto& stored = history_.reversals;
  const auto point = [&](std::size_t i) { return i < stored.size() ? stored[i] : history_.edge; };
  std::size_t n = stored.size() + (turned ? 1 : 0);
  while (n > 0) {
    const SectionHistory::Point origin = point(n - 1);
    const double end = n >= 2 ? point(n - 2).m : -origin.m;
    if (sense * (m - end) <= 0.0) return {origin.x, origin.m, 2.0, sense, sense * end};
    n -= n >= 2 ? 2 : 1;
  }
  return {0.0, 0.0, 1.0, sense, limit};
}

MomentLaw::Flow MomentLaw::beyond(double m) const { return on(branch_to(m), m); }

bool MomentLaw::commit(double m, const SectionLaw& law, double yield_curvature) {
  if (m >= low_ && m <= high_) return false;
  law.commit(history_, (m + at(m).plastic) * yield_curvature);
  plastic_ = history_.edge.x - history_.edge.m;
  const bool rose = history_.direction > 0;
  low_ = rose ? history_.edge.m - 2.0 : history_.edge.m;
  high_ = rose ? history_.edge.m : history_.edge.m + 2.0;
  rising_ = branch_to(high_ + (rose ? 0.0 : 1e-12));
  falling_ = branch_to(low_ - (rose ? 1e-12 : 0.0));
  return true;
}

}  // namespace subimpact
