#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "subimpact/study/judgement/judgement.h"

namespace subimpact {

/// Multiplies safety factors where one run alone shows a part of the error.
inline constexpr double single_run_factor = 1.5;

/// Whether runs show an error of the mesh.
inline bool of_mesh(std::span<const RunBeside> beside) {
  return std::ranges::any_of(beside, [](const RunBeside& other) {
    return other.of.of_rows && other.of.source != ErrorSource::time;
  });
}

/// Judges sub-impacts and flights of a run by the runs that show one part of its error: errors of
/// times and values, and why a sub-impact or a flight is not certain. `support_lost`: of
/// set_support_errors().
void judge_rows(const Case& input, Result& run, std::span<const RunBeside> beside,
                ErrorEstimate& estimate, double support_lost = HUGE_VAL);

}  // namespace subimpact
