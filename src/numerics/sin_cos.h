#pragma once

#include <cmath>
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

}  // namespace subimpact
