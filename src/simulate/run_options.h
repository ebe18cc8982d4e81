#pragma once

#include <cstddef>

#include "simulate/run.h"
#include "subimpact/model/beam_mesh.h"
#include "subimpact/simulate/options.h"
#include "subimpact/simulate/result.h"
#include "subimpact/simulate/simulate.h"

namespace subimpact {

/// Points of a recorded shape at most.
std::size_t most_shape_points(const Options& options);

/// What the loop over steps and the recorders need of a problem and its settings.
RunOptions run_options(const Problem& problem, const Options& options, const ResolvedSettings& used,
                       const BeamMesh& mesh);

}  // namespace subimpact
