#pragma once

#include "subimpact/simulate/case.h"

namespace subimpact {

/// Checks that strike and supports go together with the mesh. Throws InvalidCase.
void check_mesh(const Case& input);

}  // namespace subimpact
