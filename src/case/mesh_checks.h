#pragma once

#include "model/element_grading.h"
#include "subimpact/case/case.h"

namespace subimpact {

/// Checks that strike and supports go together with the mesh. Throws InvalidCase.
void check_mesh(const Case& input);

/// How elements shorten towards the strike.
ElementGrading grading_of(const Case& input);

}  // namespace subimpact
