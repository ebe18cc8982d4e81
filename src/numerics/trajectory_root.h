#pragma once

#include <cassert>
#include <cmath>

namespace subimpact {

/// Value of an event function and its rate of change. An event happens where the value rises
/// through zero: negative before, positive after.
struct EventValue {
  double value = 0.0;
  double rate = 0.0;
};

struct RootOptions {
  double tolerance = 0.0;   ///< on time, s: two iterates closer than this end the search
  int max_iterations = 60;  ///< bisection alone needs about 50
};

/// The time in (a, b] at which `guard(t)` rises through zero: Newton's method from `guess`, kept
/// inside a bracket that shrinks with every evaluation, and bisection where Newton would leave it
/// or stalls. The caller vouches for a sign change: value <= 0 just after a, > 0 at b. `guard` is
/// evaluated on the trajectory, so that the root is the trajectory's and not that of an
/// interpolant. Returns the last time at which `guard` was evaluated.
template <class Guard>
double find_rise(Guard guard, double a, double b, double guess, RootOptions options) {
  assert(a <= b && options.tolerance >= 0.0 && options.max_iterations > 0);
  double t = guess > a && guess < b ? guess : 0.5 * (a + b);
  double last_size = 2.0 * (b - a);
  for (int i = 1;; ++i) {
    const EventValue at = guard(t);
    if (at.value == 0.0 || i == options.max_iterations) return t;
    (at.value < 0.0 ? a : b) = t;
    double next = t - at.value / at.rate;
    const bool usable = at.rate > 0.0 && next >= a && next <= b;
    if (usable && std::abs(next - t) <= options.tolerance) return t;
    if (b - a <= options.tolerance) return t;
    if (!usable || std::abs(next - t) > 0.5 * last_size) next = 0.5 * (a + b);
    last_size = std::abs(next - t);
    t = next;
  }
}

}  // namespace subimpact
