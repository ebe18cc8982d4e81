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

}  // namespace subimpact
