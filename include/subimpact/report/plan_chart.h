#pragma once

#include <filesystem>

#include "subimpact/study/plan.h"

namespace subimpact {

/// plan.svg and .png from plan.csv, which write_plan() has written into the directory: error on x,
/// counted work on y, one line per sequence of meshes. Filled marks are admitted. Throws
/// OutputError.
void draw_plan(const std::filesystem::path& directory, const Plan& plan);

}  // namespace subimpact
