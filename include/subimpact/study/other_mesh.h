#pragma once

#include <optional>
#include <string>

#include "subimpact/case/case.h"

namespace subimpact {

struct RefinedRun {
  Case input;
  std::string description;
};

/// The order at which event times of a case converge with its mesh: 2 for cells; 4 for Hermite
/// elements, or 1 if sections may yield; nothing for a rigid beam.
std::optional<int> mesh_order(const Case& input);

/// The case on a mesh with `factor` times as many cells or elements, as nearly as the mesh allows;
/// nothing for a rigid beam or if too few would be left. A fixed step above
/// the stability limit of the finer mesh is reduced to 0.9 of that limit.
std::optional<RefinedRun> on_other_mesh(const Case& input, double factor);

/// Number of cells or elements over the whole length; 1 for a rigid beam.
int mesh_count(const Case& input);

/// "501 cells", "200 elements"; "rigid", "a mesh of its own".
std::string mesh_words(const Case& input);

}  // namespace subimpact
