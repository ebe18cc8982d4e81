#pragma once

#include <array>
#include <cmath>

namespace subimpact {

/// Stumpff's functions C_k(y) = sum_p (-y^2)^p/(2p + k)!, k = 0..5: cos y, sin y/y, (1 - cos y)/y^2
/// ...
///
/// They are the response of an oscillator to polynomial forces: with y = omega t,
///
///     integral_0^t sin(omega (t - s))/omega s^m ds = m! t^(m+2) C_{m+2}(y),
///     integral_0^t cos(omega (t - s))       s^m ds = m! t^(m+1) C_{m+1}(y),
///
/// for every y >= 0: by their series below 1 and by C_{k+2} = (1/k! - C_k)/y^2 above, where that
/// recurrence loses at most the last two digits.
inline std::array<double, 6> stumpff(double y) {
  const double y2 = y * y;
  std::array<double, 6> c;
  if (y < 1.0) {
    // Horner's rule on the series of C_4 and C_5, then the recurrence downwards.
    double fourth = 1.0;
    double fifth = 1.0;
    for (int k = 18; k >= 6; k -= 2) {
      fourth = 1.0 - y2 * fourth / (k * (k - 1.0));
      fifth = 1.0 - y2 * fifth / (k * (k + 1.0));
    }
    c[4] = fourth / 24.0;
    c[5] = fifth / 120.0;
    c[2] = 0.5 - y2 * c[4];
    c[3] = 1.0 / 6.0 - y2 * c[5];
    c[0] = 1.0 - y2 * c[2];
    c[1] = 1.0 - y2 * c[3];
  } else {
    const double inverse = 1.0 / y2;
    c[0] = std::cos(y);
    c[1] = std::sin(y) / y;
    c[2] = (1.0 - c[0]) * inverse;
    c[3] = (1.0 - c[1]) * inverse;
    c[4] = (0.5 - c[2]) * inverse;
    c[5] = (1.0 / 6.0 - c[3]) * inverse;
  }
  return c;
}

}  // namespace subimpact
