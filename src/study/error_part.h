#pragma once

#include <string>
#include <vector>

#include "subimpact/simulate/result.h"

namespace subimpact {

/// Errors of the sub-impacts and near misses of a run, from one refined or coarser run.
struct ErrorPart {
  std::string name;            ///< "time", "mesh", "layers"
  std::string refined_run;     ///< the refined run, in words
  std::vector<double> errors;  ///< s, of the leading sub-impacts that correspond
  /// m, of the gap at the leading near misses, those in the contacts and separations of the above.
  std::vector<double> gap_errors;
  std::size_t n_refined = 0;  ///< sub-impacts the refined run has
  std::string failure;        ///< why the refined run did not complete; empty: it did
  std::string open_contact;   ///< why the next sub-impact is unknown where only one run ends it
};

/// The error of each leading sub-impact that both runs have: `factor` times the largest difference
/// of starts and ends over it and its neighbours, so that a difference that happens to pass through
/// zero is not taken for accuracy. A contact that ends in one of the runs alone is not of both.
///
/// The error of the gap at each near miss: `factor` times the difference of the two runs' margins.
/// Where the other run has no such near miss, it is `factor` times the difference of the nearest
/// start or end in time, times the rate of the indentation there.
ErrorPart compare_events(const Result& result, const Result& refined_run, std::string name,
                         std::string description, double factor);

/// Gives every sub-impact its errors, part by part and in sum, and finds the first one from which
/// neither count nor order is certain: Result::error_estimate. That is the first one
///
///   - that one of the runs does not have,
///   - whose error is not small beside its duration or beside a separation next to it, or
///   - with a near miss within it or before it whose margin is below the error of the gap: in truth
///     the contact may open, or the separation close.
void set_error_bars(Result& result, const std::vector<ErrorPart>& parts);

}  // namespace subimpact
