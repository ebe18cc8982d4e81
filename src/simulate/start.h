#pragma once

#include "subimpact/simulate/simulate.h"
#include "system/struck_beam.h"

namespace subimpact {

/// Throws InvalidCase where bodies, supports and loads of a problem allow no start: a motion that
/// the supports do not allow, no equilibrium, bodies that do not approach each other.
void check_start(const Problem& problem, const Options& options);

/// Puts a beam and its striker where the problem starts, if that is not the first touch of a beam
/// at rest: a rigid motion v = Mass^-1 (functionals of momentum and moment of momentum),
/// displacements K^-1 f(0) in equilibrium. Throws InvalidCase where a section would yield.
void set_start(const Problem& problem, StruckBeam& beam);

}  // namespace subimpact
