#pragma once

#include <cstddef>
#include <span>

#include "numerics/bracketed_root.h"
#include "ode/second_order_ode.h"
#include "subimpact/ode/integrator.h"

namespace subimpact {

/// Functions of the state whose events an integrator finds by itself (Integrator::root). An event
/// happens where a value rises through zero; falling through zero, or exactly zero, is none.
class EventFunctions {
 public:
  virtual ~EventFunctions() = default;

  /// Number of functions; changes between a step and a restart only.
  virtual std::size_t size() const = 0;
  /// Values at y = [q, v], without units, of order one, and numbers of order one with the sign of
  /// their rates of change. A rate is NaN where it is not known: a value that rises through zero
  /// and falls back within one step is then missed.
  virtual void evaluate(std::span<const double> y, std::span<EventValue> values) const = 0;
};

/// One step as the integrator took it, or a part of one: times (s) and states that outlive this.
struct StepEnds {
  double t0, t1;
  const State& y0;
  const State& y1;
  bool event_free = false;  ///< proven to contain no event, whatever its ends suggest
  double length() const { return t1 - t0; }
};

}  // namespace subimpact
