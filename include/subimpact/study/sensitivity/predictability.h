#pragma once

/// How far a strike with scattering numbers can be predicted.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "subimpact/study/sensitivity/sensitivity.h"

namespace subimpact {

/// Relative standard deviations of numbers of a case, by key; independent of each other.
using Scatter = std::map<std::string, double>;

/// The standard deviation of a number with these derivatives, one per key of the study: the root of
/// the sum of (df/d ln p s_p)^2, each derivative enlarged by its error. None if a derivative by a
/// scattering key is not known.
std::optional<double> deviation_of(const std::vector<std::optional<Derivative>>& by_key,
                                   const std::vector<std::string>& keys, const Scatter& scatter);

/// Sets the standard deviations of starts and ends of a result, and Result::predictability, from a
/// study of the same case by the keys that scatter. docs/theory.md, "Derivatives and
/// predictability", lists what makes a sub-impact unpredictable.
void set_predictability(Result& result, const Sensitivity& study, const Scatter& scatter);

/// The keys of a case that scatter and by which results have a derivative.
std::vector<std::string> scattering_keys(const Case& input);

/// Largest number of runs with sampled numbers, and the bound on the counted work of all of them,
/// and of all runs for derivatives.
inline constexpr std::size_t most_samples = 64;
inline constexpr double most_work_of_scatter = 3e9;

/// Runs of sensitivity() by so many keys.
constexpr double runs_for_derivatives(double n_keys) {
  return 2.0 + 2.0 * sensitivity_shifts.size() * n_keys;
}

/// The case on a mesh, coarser if need be, on which so many runs take no more than
/// most_work_of_scatter; at least an eighth as fine. Makes a run a quarter as fine to know it.
Case affordable_case(const Case& input, double n_runs);

/// Sets Predictability::totals, and the standard deviation of the striker's velocity, which hold
/// however the numbers depend on what scatters: from runs with the numbers of Population. Returns
/// how many of them did not complete; if more than half, nothing is set.
std::size_t add_samples(Predictability& predictability, const Case& input,
                        const SensitivityOptions& options);

/// Makes the study that a case's scatter needs (sensitivity()), on an affordable_case(), and sets
/// the predictability of its result, with add_samples(). Does nothing if no scatter has an effect.
/// If the study fails or is interrupted, the result has a warning.
void add_predictability(Result& result, const Case& input, SensitivityOptions options = {});

}  // namespace subimpact
