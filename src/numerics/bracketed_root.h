#pragma once

#include <algorithm>
#include <cmath>

namespace subimpact {

/// A root of f in a bracket known to hold one: false position with the Illinois rule.
template <class F>
double root_in(F f, double a, double b) {
  double fa = f(a);
  double fb = f(b);
  for (int i = 0; i < 200; ++i) {
    const double x = b - fb * (b - a) / (fb - fa);
    if (!(x > std::min(a, b) && x < std::max(a, b))) return std::abs(fa) < std::abs(fb) ? a : b;
    const double fx = f(x);
    if (fx == 0.0) return x;
    if ((fx < 0.0) != (fb < 0.0)) {
      a = b;
      fa = fb;
    } else {
      fa *= 0.5;
    }
    if (std::abs(x - b) <= 4e-16 * std::abs(x)) return x;
    b = x;
    fb = fx;
  }
  return b;
}

}  // namespace subimpact
