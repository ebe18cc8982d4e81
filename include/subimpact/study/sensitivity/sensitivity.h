#pragma once

/// Derivatives of event times, forces and velocities by the numbers of a case.

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "subimpact/case/simulate.h"
#include "subimpact/study/judgement/judgement.h"

namespace subimpact {

/// A number that a run has for each sub-impact.
enum class EventQuantity { start, end, peak_force, impulse, max_indentation, striker_velocity };

inline constexpr std::array event_quantities = {
    EventQuantity::start,           EventQuantity::end,
    EventQuantity::peak_force,      EventQuantity::impulse,
    EventQuantity::max_indentation, EventQuantity::striker_velocity};

/// "start_s", "end_s", "peak_force_N", "impulse_Ns", "max_indentation_m",
/// "striker_velocity_m_per_s".
std::string_view to_string(EventQuantity quantity);

/// The number, in the unit that to_string() names. A sub-impact that has not ended has a start
/// only.
std::optional<double> value_of(const SubImpact& sub_impact, EventQuantity quantity);

/// df/d ln p of a number f by a key p, and its estimated error, both in the unit of f.
struct Derivative {
  double value = 0.0;
  double error = 0.0;
};

struct SensitivityRow {
  EventQuantity quantity = EventQuantity::start;
  std::size_t sub_impact = 0;  ///< from 0
  double value = 0.0;          ///< of the base run
  /// One per key of the study; none where shifted runs lack the sub-impact.
  std::vector<std::optional<Derivative>> by_key;
  /// Why the number has no derivative, or no reliable one, in words; otherwise empty.
  std::string flag;
};

/// The derivatives of the margin of one near miss of the base run.
struct NearMissSensitivity {
  std::size_t near_miss = 0;   ///< index into Result::near_misses
  std::size_t sub_impact = 0;  ///< from 0: the first that the near miss makes uncertain
  std::vector<std::optional<Derivative>> by_key;  ///< m
};

struct Sensitivity {
  Case input;   ///< of the base run
  Result base;  ///< without history rows
  std::vector<std::string> keys;
  std::vector<SensitivityRow> rows;  ///< sub-impact by sub-impact, in the order of quantities
  std::vector<NearMissSensitivity> near_misses;
  std::vector<std::string> remarks;  ///< what differs from the case, shifted runs that failed
  bool interrupted = false;          ///< `keys` are those whose runs had ended

  const SensitivityRow* find(EventQuantity quantity, std::size_t sub_impact) const;
};

struct SensitivityOptions {
  /// Names of keys; empty: sensitivity_keys(). Each is a finite number of the case, not 0.
  std::vector<std::string> keys;
  Jobs jobs = 1;
  /// Called after each run, with the numbers of finished and of all runs.
  std::function<void(std::size_t n_done, std::size_t n_all)> finished;
  Progress progress;  ///< of every run, from several threads at once; false ends all
};

/// The keys of beam, striker and contact by which event times have a derivative: finite, not 0, not
/// at an end of their range, and with an effect.
std::vector<std::string> sensitivity_keys(const Case& input);

inline constexpr std::array sensitivity_shifts = {1e-5, 1e-6};

/// The case of the base run: that of `input`, at rtol 1e-13 or less, without history rows. Where
/// events would be interpolated within fixed steps, whose phase makes times jump, the method is
/// nystrom, or erk for a damped strike.
Case sensitivity_case(const Case& input);

/// Derivatives by the logarithms of keys, from central differences of whole runs: a base run, one
/// with ten times its tolerance, and four runs per key, with the key times exp(+-h) for the two
/// shifts h of sensitivity_shifts. All have mesh, method and symmetry of the base run. Of the
/// derivatives from the two shifts, the one with the smaller error is stated, with three times that
/// error (docs/theory.md, "Derivatives and predictability"). A sub-impact is flagged if it is
/// merged, split or lost in a shifted run, if another one appears before it, if a near miss lies
/// within its change over the shifts, if the slopes on the two sides differ (a kink) or those of
/// the two shifts (about to merge, split or vanish), or if an error is a tenth of the largest
/// derivative of the row.
///
/// Throws InvalidCase, also for a key that has no derivative. If the base run does not complete, no
/// shifted run is made, and there are no keys and no rows.
Sensitivity sensitivity(const Case& input, const SensitivityOptions& options = {});

}  // namespace subimpact
