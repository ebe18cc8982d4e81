#pragma once

#include <span>

namespace subimpact {

/// Motion of a damped oscillator, q'' + 2 delta q' + omega^2 q = f(t), in closed form for every
/// omega >= 0 and delta >= 0 (1/s), overdamped or not:
///
///     q(t) = position q(0) + response q'(0) + ..,
///     q'(t) = -omega^2 response q(0) + slope q'(0) + ..,
///
/// and under the force f = t^m/m! from rest q(t) = forced[m], q'(t) = forced[m - 1], where
/// forced[-1] is `response`, the answer to a unit impulse:
///
///     omega^2 forced[m] = t^m/m! - 2 delta forced[m - 1] - forced[m - 2],   forced[-2] = slope,
///
/// by their series in t where omega t is small.
struct DampedOscillator {
  static constexpr int n_powers = 4;

  DampedOscillator(double omega, double delta, double t);

  double position, response, slope;
  double forced[n_powers];

 private:
  // The oscillator's step for twice the time t.
  DampedOscillator continued(double omega, double t) const;
};

/// Integral of q'^2 from 0 to t of such an oscillator that starts at q, v under the force
/// sum_m force[m] t^m/m!.
double integral_of_squared_velocity(double omega, double delta, double q, double v,
                                    std::span<const double, DampedOscillator::n_powers> force,
                                    double t);

}  // namespace subimpact
