#pragma once

#include <filesystem>
#include <vector>

#include "subimpact/study/work_precision.h"

namespace subimpact {

/// work_precision.svg and .png (wall time), work_precision_evaluations.svg and .png (right-hand
/// sides): error on x, cost on y, one panel per study. Runs that found all sub-impacts are filled
/// marks, those that lost or invented some hollow, those that failed crosses at the right edge.
/// Throws OutputError.
void draw_work_precision(const std::filesystem::path& directory,
                         const std::vector<WorkPrecision>& studies);

}  // namespace subimpact
