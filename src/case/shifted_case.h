#pragma once

#include <optional>
#include <string>
#include <vector>

#include "subimpact/case/case_keys.h"

namespace subimpact {

bool is_number_of_scene(const CaseKey& key);

/// Why results have no derivative by the logarithm of a key of the case, as a message that begins
/// with "is"; nothing if they have one. A key has one if it is a finite number of the scene or of
/// the mesh, other than 0 and inside its range, and if it takes effect.
std::optional<std::string> why_not_shifted(const Case& input, const CaseKey& key);

/// The keys of the scene (beam, striker, contact) by which results have a derivative.
std::vector<std::string> shifted_keys(const Case& input);

}  // namespace subimpact
