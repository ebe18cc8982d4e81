#pragma once

#include <optional>
#include <string>

#include "subimpact/model/scene.h"
#include "subimpact/simulate/options.h"
#include "subimpact/simulate/result.h"
#include "subimpact/simulate/simulate.h"

namespace subimpact {

// Settings of the method as a run uses them. All throw InvalidCase, by the key, for what the method
// cannot take; `used` is what has been resolved before.

/// The given table, or the first one of the method; none for a method without tables.
std::optional<std::string> table_used(const Options& options);

/// None for a method without orders.
std::optional<int> max_order_used(const Options& options);

/// Section events are found on paths of an undamped strike alone.
ReversalHandling reversals_used(const Problem& problem, const Options& options, bool can_yield);

/// The fixed step, s; none where the method chooses its steps. Needs the critical step and the
/// contact's time scale in `used`.
std::optional<double> step_used(const Options& options, const ResolvedSettings& used);

/// Events, reversals and steps. Needs those of `used`.
void check_method(const Options& options, const ResolvedSettings& used, bool can_yield);

void check_contact_damping(const Problem& problem, const Options& options,
                           const ResolvedSettings& used);

void check_beam_damping(const BeamDamping& damping, const Options& options, bool can_yield);

}  // namespace subimpact
