#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "numerics/lanes.h"

namespace subimpact {

struct SinCos {
  Lanes sine, cosine;
};

/// Sine and cosine of eight numbers at once, to two units in the last place.
///
/// The multiple k pi/2 nearest to y is subtracted in three parts of pi/2, the first two of 33 bits,
/// so that their products with k are exact; then come the polynomials of fdlibm (Sun Microsystems
/// 1993) for angles up to pi/4. Beyond 1e6 the standard library is used.
inline SinCos sin_cos(const Lanes& y) {
  constexpr double largest = 1e6;
  constexpr double to_integer = 0x1.8p52;  // added: the sum's last bits are the nearest integer's
  const Lanes shifted = y * 6.36619772367581382433e-01 + to_integer;
  const Lanes turns = shifted - to_integer;
  LaneMask quarter;
  std::memcpy(&quarter, &shifted, sizeof(quarter));
  Lanes r = y - turns * 1.57079632673412561417e+00;
  r -= turns * 6.07710050630396597660e-11;
  r -= turns * 2.02226624879595063154e-21;
  const Lanes z = r * r;
  const Lanes s =
      r + r * z *
              (-1.66666666666666324348e-01 +
               z * (8.33333333332248946124e-03 +
                    z * (-1.98412698298579493134e-04 +
                         z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 +
                                                                z * 1.58969099521155010221e-10)))));
  const Lanes c =
      1.0 - 0.5 * z +
      z * z *
          (4.16666666666666019037e-02 +
           z * (-1.38888888888741095749e-03 +
                z * (2.48015872894767294178e-05 +
                     z * (-2.75573143513906633035e-07 +
                          z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
  const LaneMask odd = (quarter & 1) != 0;
  SinCos result{odd ? c : s, odd ? s : c};
  result.sine = (quarter & 2) != 0 ? -result.sine : result.sine;
  result.cosine = ((quarter + 1) & 2) != 0 ? -result.cosine : result.cosine;
  if (any((y > largest) | (y < -largest))) {
    for (std::size_t i = 0; i < n_lanes; ++i) {
      if (std::abs(y[i]) <= largest) continue;
      result.sine[i] = std::sin(y[i]);
      result.cosine[i] = std::cos(y[i]);
    }
  }
  return result;
}

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
