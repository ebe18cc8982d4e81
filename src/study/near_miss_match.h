#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "subimpact/simulate/result.h"

namespace subimpact {

/// The sub-impact (from 0) from which on a run is in doubt if its near miss was none: the one that
/// nearly opens, or the one after the separation that nearly closes.
std::size_t first_in_doubt(const Result& run, const NearMiss& near_miss);

/// For each near miss of a run the one of another run that corresponds to it, as an index, or none:
/// of the same kind, in the same contact or separation, each the nearest in time to the other. Only
/// the contacts and separations up to that after the first `n_matched` sub-impacts are looked at.
/// The list ends with the last near miss among these.
std::vector<std::optional<std::size_t>> match_near_misses(const Result& run, const Result& other,
                                                          std::size_t n_matched);

}  // namespace subimpact
