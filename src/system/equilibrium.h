#pragma once

#include <optional>
#include <vector>

#include "system/struck_beam.h"

namespace subimpact {

/// K^-1 f of the loads f at the start of their piece, with the stiffness K of an elastic beam: its
/// displacements at rest under them. Nothing where K is not positive definite.
std::optional<std::vector<double>> equilibrium(const StruckBeam& beam);

}  // namespace subimpact
