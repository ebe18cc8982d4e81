#pragma once

#include "model/contact/mid_plane_contact.h"

namespace subimpact {

struct BodiesOfBall {
  double radius, depth;     ///< R, d, m
  double beam_modulus;      ///< E, Pa
  double beam_poisson;      ///< nu
  double modulus;           ///< E* of both, Pa
  double of_ellipse = 1.0;  ///< F_2: approach over that of a circle, under the same force
};

/// A ball on a beam, or on a half-space (infinite d), with E* of both bodies, E and nu of the beam,
/// the depth d of its mid-plane and theta = atan(a/d):
///
///     F      = 4 E* a^3/(3 R)   (elastic: Hertz)
///     lambda = a^2/(2 R) + 3 F/(8 E* a) - C(a) F
///     C      = 3 (1 + nu)/(2 pi E a^3) (d^2 (a/d - theta) + (1 - nu) ((a^2 + d^2) theta - a d))
///
/// C F is what a half-space moves at the depth d under Hertz's pressure, which is no indentation
/// but belongs to the beam: under a rigid ball, for small a, the share
/// 4/3 (3 - 2 nu)/(2 pi (1 - nu)) a/d of Hertz's. Valid up to a = d.
///
/// A touch in an ellipse counts as one in a circle of the same area, with R the geometric mean of
/// the radii of the gap, and 2 F_2 - 1 times the second term of lambda, so that the elastic
/// stiffness is that of the ellipse. For mild ones: pressures are 2 % off where one radius is twice
/// the other, a tenth where it is five times the other.
///
/// Source: K. L. Johnson, Contact Mechanics, sections 3.2 (Boussinesq's displacement of a point
/// load, here integrated over the pressure), 4.2 and 6.3.
NoseOnBeam ball_on_beam(const BodiesOfBall& bodies);

}  // namespace subimpact
