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

}  // namespace subimpact
