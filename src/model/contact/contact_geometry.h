#pragma once

#include <cmath>

#include "subimpact/model/scene.h"

namespace subimpact {

/// 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2, 1/Pa; an infinite modulus is a rigid body.
double contact_compliance(double modulus_1, double poisson_1, double modulus_2, double poisson_2);

/// Radii (m) of the gap between two surfaces that touch, along the beam and across it; infinite
/// where the gap is straight.
struct GapRadii {
  double along, across;
  /// Equal but for rounding.
  bool is_circle() const { return std::abs(along - across) <= 1e-12 * along; }
  /// Whether the surfaces touch in an ellipse, neither in a circle nor along a line.
  bool is_ellipse() const { return std::isfinite(across) && !is_circle(); }
};
/// Radii of the gap between the nose (its radius is needed) and the struck surface, flat or round.
GapRadii gap_radii(const Scene& scene);

/// K (N/m^1.5) of Hertz's contact of finite radii: 4/3 E* sqrt(R) where they are equal; otherwise
/// the surfaces touch in an ellipse. Source: K. L. Johnson, Contact Mechanics, equations 4.25-4.28.
double hertz_stiffness(GapRadii radii, double compliance);

}  // namespace subimpact
