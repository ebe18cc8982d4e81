#include "model/moment_law.h"

namespace subimpact {

// As SectionLaw::branch_at, by moments: an older branch takes over where the motion passes the
// reversal point before the last.
MomentLaw::Branch MomentLaw::branch_to(double m) const {
  const bool turned = direction_ * (m - edge_.m) < 0.0;
  const double sense = turned ? -direction_ : direction_;
  const auto& stored = history_.reversals;
  const auto point = [&](std::size_t i) { return i < stored.size() ? stored[i] : edge_; };
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

void MomentLaw::catch_up(const SectionLaw& law, double yield_curvature) const {
  if (!lags_) return;
  law.commit(history_, edge_.x * yield_curvature);
  lags_ = false;
}

bool MomentLaw::commit(double m, const SectionLaw& law, double yield_curvature) {
  if (m >= low_ && m <= high_) return false;
  const Flow reached = at(m);
  const bool rises = m > high_;
  const Branch& branch = rises ? rising_ : falling_;
  const bool goes_on = direction_ == (rises ? 1 : -1) && m * branch.sense <= branch.end;
  plastic_ = reached.plastic;
  if (goes_on) {
    move_on({m + reached.plastic, m});
    return true;
  }
  catch_up(law, yield_curvature);
  law.commit(history_, (m + reached.plastic) * yield_curvature);
  edge_ = history_.edge;
  direction_ = history_.direction;
  see_window();
  rising_ = branch_to(high_ + (rises ? 0.0 : 1e-12));
  falling_ = branch_to(low_ - (rises ? 1e-12 : 0.0));
  return true;
}

// Along the present branch; the next reversal would be here.
void MomentLaw::move_on(SectionHistory::Point to) {
  edge_ = to;
  lags_ = true;
  see_window();
  Branch& back = direction_ > 0 ? falling_ : rising_;
  back.x = to.x;
  back.m = to.m;
  if (history_.reversals.empty()) back.end = std::abs(to.m);
}

void MomentLaw::see_window() {
  low_ = direction_ > 0 ? edge_.m - 2.0 : edge_.m;
  high_ = direction_ > 0 ? edge_.m : edge_.m + 2.0;
}

}  // namespace subimpact
