#pragma once

#include <span>

#include "subimpact/study/judgement.h"

namespace subimpact {

/// Sets the totals of an error estimate: numbers of the run as a whole, each with the largest of
/// 2.7 gain |difference| over the runs beside it, summed over the parts (mean velocity of the beam:
/// 3.5, dissipated energy: 4, largest force and indentation: 5; 1.5 times more for a part of one
/// run). Counts have the largest difference itself, and at least the number of sub-impacts and
/// flights that are not certain.
void set_totals(const Case& input, const Result& run, std::span<const RunBeside> beside,
                ErrorEstimate& estimate);

}  // namespace subimpact
