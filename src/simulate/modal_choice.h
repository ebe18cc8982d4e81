#pragma once

#include "subimpact/model/beam_mesh.h"
#include "subimpact/model/scene.h"
#include "subimpact/simulate/options.h"
#include "system/struck_beam.h"

namespace subimpact {

/// Whether an elastic beam on this mesh is integrated in its natural modes, which a damping ratio
/// needs. Explicit methods see the same motion in either unknowns, but a step in modes needs no
/// mass solve.
bool in_modes(const Options& options, const BeamMesh& mesh, const BeamDamping& damping);

/// Whether resolve() has left a beam in the unknowns of its mesh that is to run in modes.
bool modes_are_left_out(const Options& options, const StruckBeam& beam);

/// The work of finding the modes that a run needs, in entries of right-hand sides.
double decomposition_of(const Options& options, const StruckBeam& beam);

/// What a run takes at most, in bytes; history goes to the disk.
double memory_of(const Options& options, const StruckBeam& beam);

}  // namespace subimpact
