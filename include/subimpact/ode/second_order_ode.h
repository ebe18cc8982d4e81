#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace subimpact {

/// Positions and velocities in one array, [q, v], both of n entries.
using State = std::vector<double>;

/// q'' = a(q), autonomous: all that an explicit integrator needs. Between two events, and with the
/// memory of the laws frozen, the acceleration depends on positions alone; in an ODE that
/// depends_on_velocity(), q'' = a(q, v), v = q', which not every method can integrate.
class SecondOrderOde {
 public:
  virtual ~SecondOrderOde() = default;

  /// n, the number of positions.
  virtual std::size_t n_positions() const = 0;
  /// a(q) for q of n entries; changes no history. Not for an ODE that depends_on_velocity().
  virtual void acceleration(std::span<const double> positions, std::span<double> result) = 0;
  virtual bool depends_on_velocity() const { return false; }
  /// Called before each evaluation with its time, s: for accelerations that depend on it.
  virtual void set_time(double /*t*/) {}
  /// a(q, v) at y = [q, v], of any ODE.
  virtual void acceleration_at(std::span<const double> y, std::span<double> result) {
    acceleration(y.first(n_positions()), result);
  }
  /// Typical sizes of a position and of a velocity, from which absolute tolerances are derived.
  struct Scales {
    double position, velocity;
  };
  virtual Scales scales() const = 0;
};

}  // namespace subimpact
