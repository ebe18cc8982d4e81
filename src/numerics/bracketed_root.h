#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace subimpact {

/// A root of f between a and b, at which f must have opposite signs (or a zero), to the last digit
/// or two: Chandrupatla's method (Adv. Eng. Softw. 28, 1997, 145-149), begun with a secant.
///
/// A new point comes from the inverse quadratic interpolant through the last three points where
/// that interpolant is monotone, else from bisection. Smooth functions take about 4 to 10
/// evaluations, other functions about 50, and more if the root is far nearer to zero than to a and
/// b: its error is relative to its own size.
template <class F>
double root_in(F f, double a, double b) {
  constexpr int most_evaluations = 200;
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  constexpr double smallest = std::numeric_limits<double>::min();
  // The root lies between `last` and `other`; `before` is the point that left the bracket last.
  double other = a;
  double f_other = f(a);
  double last = b;
  double f_last = f(b);
  if (f_other == 0.0) return a;
  if (f_last == 0.0) return b;
  assert((f_other < 0.0) != (f_last < 0.0));
  double share = f_last / (f_last - f_other);  // of the way from `last` to `other`
  for (int n = 2; n < most_evaluations; ++n) {
    const double best = std::abs(f_last) < std::abs(f_other) ? last : other;
    const double least = std::max(epsilon * std::abs(best), smallest) / std::abs(other - last);
    if (!(least < 0.5)) return best;
    const double x = last + std::clamp(share, least, 1.0 - least) * (other - last);
    const double fx = f(x);
    if (fx == 0.0) return x;
    double before = last;
    double f_before = f_last;
    if ((fx < 0.0) != (f_last < 0.0)) {
      std::swap(before, other);
      std::swap(f_before, f_other);
    }
    last = x;
    f_last = fx;
    const double xi = (last - other) / (before - other);
    const double phi = (f_last - f_other) / (f_before - f_other);
    const bool monotone = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
    share = !monotone ? 0.5
                      : f_last / (f_other - f_last) * f_before / (f_other - f_before) +
                            (before - last) / (other - last) * f_last / (f_before - f_last) *
                                f_other / (f_before - f_other);
  }
  return last;
}

/// Where a condition that holds at `a` and fails at `b` changes, by halving: the ends {holds,
/// fails} of a bracket not longer than `relative_width` times its failing end.
template <class Condition>
std::pair<double, double> bisect(Condition holds, double a, double b, double relative_width) {
  assert(relative_width >= std::numeric_limits<double>::epsilon());
  while (std::abs(b - a) > relative_width * std::abs(b)) {
    const double middle = 0.5 * (a + b);
    (holds(middle) ? a : b) = middle;
  }
  return {a, b};
}

/// Value of an event function and its rate of change. An event happens where the value rises
/// through zero: negative before, positive after.
struct EventValue {
  double value = 0.0;
  double rate = 0.0;
};

/// The time in (a, b] at which `function(t)` rises through zero: Newton's method from `guess`, kept
/// inside a bracket that shrinks with every evaluation, and bisection, which alone needs about 50
/// evaluations, where Newton would leave it or stalls. The caller guarantees a sign change: value
/// <= 0 just after a, > 0 at b. Two iterates closer than `tolerance` (s) end the search. Returns
/// the last time at which `function` was evaluated.
template <class Function>
double find_rise(Function function, double a, double b, double guess, double tolerance,
                 int most_evaluations = 60) {
  assert(a <= b && tolerance >= 0.0 && most_evaluations > 0);
  double t = guess > a && guess < b ? guess : 0.5 * (a + b);
  double last_size = 2.0 * (b - a);
  for (int i = 1;; ++i) {
    const EventValue at = function(t);
    if (at.value == 0.0 || i == most_evaluations) return t;
    (at.value < 0.0 ? a : b) = t;
    double next = t - at.value / at.rate;
    const bool usable = at.rate > 0.0 && next >= a && next <= b;
    if (usable && std::abs(next - t) <= tolerance) return t;
    if (b - a <= tolerance) return t;
    if (!usable || std::abs(next - t) > 0.5 * last_size) next = 0.5 * (a + b);
    last_size = std::abs(next - t);
    t = next;
  }
}

}  // namespace subimpact
