#pragma once

#include <limits>

#include "subimpact/simulate/result.h"

namespace subimpact {

/// Two zones; the last sub-impact is still open. Numbers that need all their digits.
inline Result sample_result() {
  Result result;
  SubImpact first;
  first.start = 0.0;
  first.end = 1.0 / 3.0 * 1e-3;
  first.peak_force = 8796.3141592653589;
  first.impulse = 0.1;
  first.max_indentation = 1.6963887700000001e-4;
  first.residual_indentation = 1.5400520000000003e-4;
  first.striker_velocity = 13.05;
  first.zone = 1;
  first.subzone = 1;
  SubImpact second = first;
  second.start = 0.5e-3;
  second.end = 0.6e-3;
  second.subzone = 2;
  SubImpact open = first;
  open.start = 5e-3;
  open.end = std::nullopt;
  open.zone = 2;
  result.sub_impacts = {first, second, open};
  result.transitions = {{0.0, EventKind::contact_begins, std::nullopt, 0.0},
                        {1e-6 / 3.0, EventKind::contact_yields, std::nullopt, 1.5e-5},
                        {2e-6 / 3.0, EventKind::section_reverses, 17, -0.7}};
  result.near_misses = {{0.1e-3 / 3.0, 2.1e-8 / 3.0, NearMissKind::opening},
                        {0.4e-3, 1e-7, NearMissKind::closing}};
  HistoryRow row{};
  row.time = 1e-6 / 3.0;
  row.force = 1822.9000000000001;
  row.momentum_error = -2.2204460492503131e-16;
  result.history = {row, row};
  result.outcome = {OutcomeKind::completed, 8e-3, "completed", {}};
  result.first_contact_yield = 1e-6 / 3.0;
  result.max_force = first.peak_force;
  result.work.steps = 1234;
  result.work.wall_seconds = 0.25;
  return result;
}

/// The same with errors of 0.0163 and 0.26 us in the first two sub-impacts, of which `n_decided`
/// are decided.
inline Result sample_result_with_errors(std::size_t n_decided) {
  Result result = sample_result();
  result.sub_impacts[0].start_error = 0.0;
  result.sub_impacts[0].end_error = 0.0163e-6;
  result.sub_impacts[1].start_error = result.sub_impacts[1].end_error = 0.26e-6;
  result.sub_impacts[2].start_error = 0.26e-6;  // still open
  ErrorEstimate estimate;
  estimate.refined_run = "the same, finer";
  if (n_decided < result.sub_impacts.size()) estimate.first_unresolved = n_decided;
  estimate.reason = n_decided < result.sub_impacts.size() ? "they part" : "";
  estimate.largest_error = 0.26e-6;
  estimate.parts = {{"mesh", "the same, finer", estimate.first_unresolved, estimate.reason,
                     estimate.largest_error}};
  result.error_estimate = estimate;
  return result;
}

}  // namespace subimpact
