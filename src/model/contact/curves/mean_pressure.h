#pragma once

#include <functional>

namespace subimpact {

/// A value and its derivative.
struct ValueAndSlope {
  double at, slope;
};

/// The mean pressure p_m (Pa) under a round nose that a yielding surface carries, as a function of
/// the half width a (m) of the contact (the radius, under a ball). Up to first yield, a_y, it is
/// Hertz's: 2/3 of the pressure p_0 in the middle under a ball, pi/4 under a cylinder. Beyond, with
/// q = a_y/a, either the pressure is cut off at a constant p_y = p_0(a_y), as Thornton does,
///
///     ball      p_m = p_y (1 - q^2/3)
///     cylinder  p_m = p_y/2 (sqrt(1 - q^2) + asin(q)/q),
///
/// where p_y is a largest pressure, which the mean nears when fully plastic; or the mean rises with
/// the depth of the dent, x = E* a/(Y R), by the model of an expanding core:
///
///     ball      p_c/Y = 1/2 + 2/3 (1 + ln(x/3))
///     cylinder  p_c/Y = (1 + ln(4 x/(3 pi)))/sqrt(3)
///     p_m = p (1 + (p/p_f)^16)^(-1/16),  p = p_c + A q^1.5 + B q^3,  p_f = 2.8 Y (fully plastic)
///
/// from p_0 = 1.6 Y (ball) or 1.67 Y (cylinder) on. A and B make p_m and its slope Hertz's at a_y:
/// the core model, which takes the contact for a core under even pressure, does not have them
/// there. The cut-off that belongs to this mean is the p_y of the first formulas.
///
/// Sources: K. L. Johnson, Contact Mechanics, sections 6.1 and 6.3; the 1/2: C. J. Studman, M. A.
/// Moore, S. E. Jones, On the correlation of indentation experiments, J. Phys. D 10 (1977) 949.
struct MeanPressure {
  enum class Nose { ball, cylinder };

  double first_yield;                              ///< a_y
  std::function<ValueAndSlope(double)> beyond_it;  ///< p_m, dp_m/da for a > a_y
};

/// p_y, Y and E* in Pa, R in m; std::invalid_argument unless they are positive and finite.
MeanPressure cut_off_pressure(MeanPressure::Nose nose, double p_y, double modulus, double radius);
MeanPressure pressure_by_depth(MeanPressure::Nose nose, double Y, double modulus, double radius);

/// Largest pressure over yield stress at which metals yield under a ball and under a cylinder.
inline constexpr double yield_pressure_over_stress = 1.6;
inline constexpr double yield_pressure_over_stress_of_line = 1.67;

}  // namespace subimpact
