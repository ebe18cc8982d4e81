#pragma once

#include <optional>

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// What shear would do to the first contact of a run whose theory leaves it out, from two further
/// runs up to there, with and without shear, on the same coarse cells, undamped (nu = 0.3 unless
/// given). Contacts that shear merges make it large. Nothing where the theory has shear, on a rigid
/// beam and on a mesh of the user's own, and where no first contact ended.
std::optional<NeglectedShear> neglected_shear(const Case& input, const Result& result);

}  // namespace subimpact
