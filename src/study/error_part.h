#pragma once

#include <string>
#include <vector>

#include "subimpact/simulate/result.h"

namespace subimpact {

/// Errors of the sub-impacts of a run, from one refined run.
struct ErrorPart {
  std::string name;            ///< "time", "mesh", "layers"
  std::string refined_run;     ///< the refined run, in words
  std::vector<double> errors;  ///< s, of the leading sub-impacts that correspond
  std::size_t n_refined = 0;   ///< sub-impacts the refined run has
  std::string failure;         ///< why the refined run did not complete; empty: it did
};

/// The error of each leading sub-impact that both runs have: `factor` times the largest difference
/// of starts and ends over it and its neighbours, so that a difference that happens to pass through
/// zero is not taken for accuracy.
ErrorPart compare_events(const Result& result, const Result& refined_run, std::string name,
                         std::string description, double factor);

/// Gives every sub-impact its errors, part by part and in sum, and finds the first one from which
/// neither count nor order is certain: Result::error_estimate.
void set_error_bars(Result& result, const std::vector<ErrorPart>& parts);

}  // namespace subimpact
