#pragma once

#include "ode/second_order_ode.h"

namespace subimpact {

/// One step as the integrator took it, or a part of one: times (s) and states of both ends, which
/// must outlive this.
struct StepEnds {
  double t0, t1;
  const State& y0;
  const State& y1;
  bool event_free = false;  ///< proven to contain no event, whatever its ends suggest
  double length() const { return t1 - t0; }
};

}  // namespace subimpact
