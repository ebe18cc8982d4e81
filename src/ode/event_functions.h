#pragma once

#include <cstddef>
#include <span>

#include "numerics/trajectory_root.h"

namespace subimpact {

/// Functions of the state whose events an integrator finds by itself (Integrator::root). An event
/// happens where a value rises through zero; a value that falls through zero, or is exactly zero,
/// is none.
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

}  // namespace subimpact
