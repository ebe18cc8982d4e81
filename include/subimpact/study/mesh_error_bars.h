#pragma once

#include <optional>

#include "subimpact/case/simulate.h"
#include "subimpact/study/error_bars.h"

namespace subimpact {

/// Runs a case with refined runs for every source of error that a finer computation reveals:
///
/// | part | refined run | stated error |
/// |---|---|---|
/// | time | more accurate in time, see simulate_with_error_bars | 3 d |
/// | mesh | twice as many cells or elements | 1.5 d/(1 - r^-p); cells: at least that of free ends |
/// | layers | the exact section on the same mesh, where the case has layers | 1.5 d |
///
/// with d the largest difference between the two runs over a sub-impact and its neighbours, r the
/// ratio of the meshes and p the order of the mesh (mesh_order). Parts add up to start_error and
/// end_error. Result::error_estimate names the first sub-impact whose existence or order is not
/// certain, in all and part by part. No part contains the error of the model (shear, friction,
/// strain rates).
///
/// A third mesh, half as fine, shows whether times converge at order p; where the ratio of their
/// differences is within 35 % of the ratio for order p, times are extrapolated to the limit of fine
/// meshes, with an uncertainty equal to the extrapolation beyond the finest mesh.
///
/// The runs on finer and coarser meshes go on beside the others. `progress` follows the case's own
/// run, then the refined run in time; returning false stops all. `rows`, if any, takes the rows of
/// the case's own run. Throws InvalidCase.
Result simulate_with_all_error_bars(const Case& input, const Progress& progress = {},
                                    RowSink* rows = nullptr);

/// The order at which event times of a case converge with its mesh: cells 2; Hermite elements 4,
/// but where sections may yield 2, without hinges 1; nothing for a rigid beam.
std::optional<int> mesh_order(const Case& input);

/// The same case on a mesh with `factor` times as many cells or elements, as nearly as the mesh
/// allows, of the same grading; nothing for a rigid beam or where too few would be left. A fixed
/// step above the stability limit of the finer mesh is reduced to 0.9 of that limit.
std::optional<RefinedRun> on_other_mesh(const Case& input, double factor);

/// Its cells or elements over the whole length; 1 for a rigid beam.
int mesh_count(const Case& input);

}  // namespace subimpact
