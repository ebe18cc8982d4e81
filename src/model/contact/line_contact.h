#pragma once

#include "model/contact/mid_plane_contact.h"

namespace subimpact {

struct BodiesOfLine {
  double radius, width, depth;  ///< R, b, d, m
  double beam_modulus;          ///< E_1* = E_1/(1 - nu_1^2), Pa
  double beam_poisson;          ///< nu_1
  double nose_modulus;          ///< E_2*, Pa; infinite: rigid
};

/// A cylinder across a beam, which touches it along a line: per width F' = F/b, with
/// 1/E* = 1/E_1* + 1/E_2*, k = nu_1/(1 - nu_1) and the depth d of the mid-plane,
///
///     F'     = pi E* a^2/(4 R)   (elastic)
///     lambda = a^2/(2 R) - 2 F'/(pi E*)
///              + F'/(pi E_1*) (2 ln(2 d/a) - k) + F'/(pi E_2*) (2 ln(4 R/a) - 1)
///
/// The first two terms are the shape under Hertz's pressure (an even one would have -1.77 for -2),
/// the next ones what beam and nose give way down to the mid-plane and up to the middle of the
/// nose: the approach of points far away is infinite. Plane strain: for noses much longer than the
/// contact is wide, while the last three terms exceed F'/(2 pi E*); under a rigid nose that is up
/// to a = 2 d exp(-(k + 2.5)/2), and unloading turns back at 2 d exp(-(k + 1)/2).
///
/// Source: K. L. Johnson, Contact Mechanics, equations 4.43, 4.45, 5.57 and 5.58, of
/// which a nose has half: a cylinder between two plates.
NoseOnBeam cylinder_across(const BodiesOfLine& bodies);

}  // namespace subimpact
