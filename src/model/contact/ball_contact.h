#pragma once

#include "model/contact/mid_plane_contact.h"

namespace subimpact {

struct BodiesOfBall {
  double radius, depth;  ///< R, d, m
  double beam_modulus;   ///< E, Pa
  double beam_poisson;   ///< nu
  double modulus;        ///< E* of both, Pa
};

/// A ball on a beam, with E* of both bodies, E and nu of the beam, the depth d of its mid-plane and
/// theta = atan(a/d):
///
///     F      = 4 E* a^3/(3 R)   (elastic: Hertz)
///     lambda = a^2/(2 R) + 3 F/(8 E* a) - C(a) F
///     C      = 3 (1 + nu)/(2 pi E a^3) (d^2 (a/d - theta) + (1 - nu) ((a^2 + d^2) theta - a d))
///
/// C F is what a half-space moves at the depth d under Hertz's pressure, which is no indentation
/// but belongs to the beam: under a rigid ball, for small a, the share
/// 4/3 (3 - 2 nu)/(2 pi (1 - nu)) a/d of Hertz's. An infinite d gives that of a half-space. Valid
/// up to a = d.
///
/// Source: K. L. Johnson, Contact Mechanics, sections 3.2 (Boussinesq's displacement of a point
/// load, here integrated over the pressure), 4.2 and 6.3.
NoseOnBeam ball_on_beam(const BodiesOfBall& bodies);

}  // namespace subimpact
