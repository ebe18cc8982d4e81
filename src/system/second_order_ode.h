#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace subimpact {

/// Positions and velocities in one array, [q, v], both of n entries.
using State = std::vector<double>;

/// q'' = a(q), autonomous: all an explicit integrator needs to know. Between two events, and with
/// the memory of the laws frozen, the acceleration depends on positions alone.
class SecondOrderOde {
 public:
  virtual ~SecondOrderOde() = default;

  /// n, the number of positions.
  virtual std::size_t n_positions() const = 0;
  /// a(q) for q of n entries; changes no history.
  virtual void acceleration(std::span<const double> positions, std::span<double> result) = 0;
  /// Typical sizes of a position and of a velocity in this problem, from which absolute tolerances
  /// are derived.
  struct Scales {
    double position, velocity;
  };
  virtual Scales scales() const = 0;
};

}  // namespace subimpact
