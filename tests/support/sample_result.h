#pragma once

#include <algorithm>

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
  first.opening = 1.2345678901234567e-5;
  first.zone = 1;
  first.subzone = 1;
  SubImpact second = first;
  second.start = 0.5e-3;
  second.end = 0.6e-3;
  second.subzone = 2;
  SubImpact open = first;
  open.start = 5e-3;
  open.end = open.opening = std::nullopt;
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
  result.restitution = 0.20302;
  result.first_touch.striker = 15.9;
  result.work.steps = 1234;
  result.work.wall_seconds = 0.25;
  return result;
}

/// The same with errors of 0.0163 and 0.26 us in the first two sub-impacts, of which `n_certain`
/// are certain, as the judgement of a run leaves it.
inline Result sample_result_with_errors(std::size_t n_certain) {
  Result result = sample_result();
  const std::size_t n = result.sub_impacts.size();
  ErrorEstimate estimate;
  estimate.refined_run = "the same, coarser";
  if (n_certain < n) {
    estimate.first_unresolved = n_certain;
    estimate.reason = Reason{{}, "they part"};
  }
  for (std::size_t i = 0; i < n; ++i) {
    SubImpact& s = result.sub_impacts[i];
    const bool first = i == 0;
    const double error = first ? 0.0163e-6 : 0.26e-6;
    s.certain = i < n_certain;
    s.probability = *s.certain ? 1.0 : 0.75;
    if (!*s.certain) s.doubt = Reason{{}, "they part"};
    s.start_error = first ? 0.0 : error;
    if (s.end) s.end_error = error;
    s.peak_force_error = first ? 0.43 : 46.0;
    s.impulse_error = first ? 4.9e-6 : 5.2e-4;
    s.max_indentation_error = s.residual_indentation_error = first ? 8e-9 : 9e-7;
    s.striker_velocity_error = first ? 6.4e-4 : 0.068;
    if (s.opening) s.opening_error = first ? 3e-8 : 2e-6;
    if (*s.certain) estimate.largest_error = error;
  }
  const auto count = [&](std::size_t from, std::size_t to) {  // of [from, to), uncertain ones
    const std::size_t n_before = std::clamp(n_certain, from, to);
    return Total{static_cast<double>(to - from), static_cast<double>(to - n_before)};
  };
  estimate.totals = {
      {RunTotal::sub_impacts, count(0, n)},
      {RunTotal::zones, {2.0, 0.0}},
      {RunTotal::striker_velocity, {result.striker_velocity, 6.4e-4}},
      {RunTotal::beam_mean_velocity, {result.beam_mean_velocity, 5.7e-4}},
      {RunTotal::restitution, {0.0, 7.6e-5}},
      {RunTotal::impulse, {0.3, 1.1e-3}},
      {RunTotal::peak_force, {result.max_force, 0.43}},
      {RunTotal::max_indentation, {result.max_indentation, 8e-9}},
      {RunTotal::residual_indentation, {result.sub_impacts.back().residual_indentation, 9e-7}}};
  estimate.zones = {{{0.0, 0.0}, {0.6e-3, 0.26e-6}, {0.2, 5.3e-4}, count(0, 2)},
                    {{5e-3, 0.26e-6}, {result.outcome.time, 0.0}, {0.1, 5.2e-4}, count(2, 3)}};
  result.error_estimate = estimate;
  return result;
}

/// The same, all certain, but that there may be another sub-impact after one of them (from 0).
inline Result sample_result_with_an_uncertain_flight(std::size_t after) {
  Result result = sample_result_with_errors(sample_result().sub_impacts.size());
  ErrorEstimate& estimate = *result.error_estimate;
  estimate.uncertain_flights = {{after, {Reason::Kind::another_beside, "the same, coarser"}}};
  estimate.first_unresolved = after + 1;
  estimate.reason = estimate.uncertain_flights.front().reason;
  estimate.totals.front().total.error = 1.0;
  return result;
}

}  // namespace subimpact
