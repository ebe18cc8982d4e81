#pragma once

#include <optional>
#include <string>

#include "subimpact/simulate/simulate.h"
#include "system/struck_beam.h"

namespace subimpact {

// Settings of the method as a run uses them. All throw InvalidCase, by the key, for what the method
// cannot take; `used` is what has been resolved before.

/// The given table, or the first one of the method; none for a method without tables.
/// For a mesh that is made for one step of central differences. Throws InvalidCase for another
/// method, settings that would change the step, or a contact too stiff for it.
void check_natural_step(const Options& options, const ResolvedSettings& used);

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

/// Whether an elastic beam on this mesh is integrated in its natural modes, which a damping ratio
/// needs. Explicit methods see the same motion in both, but a step in modes needs no mass solve.
bool in_modes(const Options& options, const BeamMesh& mesh, const BeamDamping& damping);

/// Whether resolve() has left a beam in the unknowns of its mesh that is to run in modes.
bool modes_are_left_out(const Options& options, const StruckBeam& beam);

/// The work of finding the modes that a run needs, in entries of right-hand sides.
double decomposition_of(const Options& options, const StruckBeam& beam);

/// What a run takes at most, in bytes; history goes to the disk.
double memory_of(const Options& options, const StruckBeam& beam);

}  // namespace subimpact
