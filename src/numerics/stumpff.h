#pragma once

#include <cassert>
#include <cstddef>

#include "numerics/lanes.h"
#include "numerics/sin_cos.h"

namespace subimpact {

/// Stumpff's functions C_k(y) = sum_p (-y^2)^p/(2p + k)!, k = 0..5: cos y, sin y/y, (1 - cos y)/y^2
/// ...
///
/// They are the response of an oscillator to polynomial forces: with y = omega t,
///
///     integral_0^t sin(omega (t - s))/omega s^m ds = m! t^(m+2) C_{m+2}(y),
///     integral_0^t cos(omega (t - s))       s^m ds = m! t^(m+1) C_{m+1}(y),
///
/// for every y >= 0, here eight at once: by their series below 1 and by C_{k+2} = (1/k! - C_k)/y^2
/// above, where that recurrence loses at most the last two digits.
struct StumpffLanes {
  Lanes values[6];
  const Lanes& operator[](std::size_t k) const { return values[k]; }
};

inline StumpffLanes stumpff(const Lanes& y) {
  assert(!any(y < 0.0));
  const Lanes y2 = y * y;
  const LaneMask small = y < 1.0;
  const Lanes inverse = 1.0 / (small ? Lanes{} + 1.0 : y2);
  const SinCos at = sin_cos(y);
  Lanes c[6];
  c[0] = at.cosine;
  c[1] = at.sine * (y * inverse);
  c[2] = (1.0 - c[0]) * inverse;
  c[3] = (1.0 - c[1]) * inverse;
  c[4] = (0.5 - c[2]) * inverse;
  c[5] = (1.0 / 6.0 - c[3]) * inverse;
  if (any(small)) {
    // Horner's rule on the series of C_4 and C_5, then the recurrence downwards.
    Lanes fourth = Lanes{} + 1.0;
    Lanes fifth = fourth;
    for (int k = 18; k >= 6; k -= 2) {
      fourth = 1.0 - y2 * fourth * (1.0 / (k * (k - 1.0)));
      fifth = 1.0 - y2 * fifth * (1.0 / (k * (k + 1.0)));
    }
    fourth /= 24.0;
    fifth /= 120.0;
    const Lanes second = 0.5 - y2 * fourth;
    const Lanes third = 1.0 / 6.0 - y2 * fifth;
    c[0] = small ? 1.0 - y2 * second : c[0];
    c[1] = small ? 1.0 - y2 * third : c[1];
    c[2] = small ? second : c[2];
    c[3] = small ? third : c[3];
    c[4] = small ? fourth : c[4];
    c[5] = small ? fifth : c[5];
  }
  return {{c[0], c[1], c[2], c[3], c[4], c[5]}};
}

}  // namespace subimpact
