#pragma once

#include <vector>

#include "system/struck_beam.h"

namespace subimpact {

/// Coefficients, on the velocities of the unknowns, of the velocity (m/s) that the struck point
/// would have if the beam moved as a rigid body with its momentum and moment of momentum: a body
/// free to move and turn, or one that turns about its one pinned end. Between other supports, and
/// on springs, it stands still (nothing); against a stop a beam on springs counts as free, one
/// between other supports has its mean velocity, as has a free beam whose mesh does not give the
/// moment of momentum.
std::vector<double> rigid_motion_at_struck_point(const StruckBeam& struck_beam, const Beam& beam,
                                                 double position);

}  // namespace subimpact
