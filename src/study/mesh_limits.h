#pragma once

#include <span>

#include "subimpact/study/judgement.h"

namespace subimpact {

/// Sets starts and ends of sub-impacts in the limit of fine meshes, where those of the run and of
/// the second and third run beside it, on coarser and coarser meshes, converge at the order of the
/// mesh.
void set_mesh_limits(const Case& input, Result& run, std::span<const RunBeside> beside);

}  // namespace subimpact
