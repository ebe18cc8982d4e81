#pragma once

#include "model/contact/mid_plane_contact.h"

namespace subimpact {

// Noses on the paper's beam, as MidPlaneContact needs them.

using Nose = MeanPressure::Nose;

inline const double R = 0.01, width = 0.0163, d = 0.00375, nu = 0.33, E = 72e9, Y = 150e6;
inline const double E1 = E / (1.0 - nu * nu), k = nu / (1.0 - nu);
inline const double rigid = std::numeric_limits<double>::infinity();
inline const double of_steel = 210e9 / (1.0 - 0.09);

inline double both(double of_nose) { return 1.0 / (1.0 / E1 + 1.0 / of_nose); }

using Pressure = std::optional<MeanPressure>;

inline MidPlaneContact line(Pressure pressure, double of_nose = rigid) {
  return {"line", cylinder_across({R, width, d, E1, nu, of_nose}), pressure};
}

inline MidPlaneContact ball(Pressure pressure, double depth = d, double of_nose = rigid) {
  return {"sphere", ball_on_beam({R, depth, E, nu, both(of_nose)}), pressure};
}

inline Pressure cut_off(Nose nose, double of_yield_stress, double of_nose = rigid) {
  return cut_off_pressure(nose, of_yield_stress * Y, both(of_nose), R);
}
inline Pressure by_depth(Nose nose, double of_nose = rigid) {
  return pressure_by_depth(nose, Y, both(of_nose), R);
}

}  // namespace subimpact
