#pragma once

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// The mesh size that resolves short contacts, by the bending waves that they send out
/// (docs/theory/errors.md, "Too coarse a mesh").

/// Number of parts over the whole length that puts eight cells into the waves of contacts as short
/// as `contact_time` (s), from 64 cells to `most_cells`.
int parts_that_resolve(const Case& input, double contact_time, double most_cells = 1e9);
/// Whether half of a mesh of low order still resolves them: then one run on a near mesh tells as
/// much about existence as two (validation/truth/judgement).
bool resolves_amply(const Case& input, double contact_time);
/// The most that the program chooses without having run the case.
constexpr double most_cells_at_first = 2000.0;
/// The most that the program chooses for a strike near an end, or a light striker.
int most_parts_at_first(const Case& input);
/// Whether so many take a strike as close to an end as that of the case.
bool takes_strike(const Case& input);

/// Parts of a mesh that takes the strike, as coarser ones beside it do: as many as the case has, or
/// as leave no mesh_doubt, on the mesh and on coarser ones beside it, towards the nearest end.
int parts_that_take_strike(const Case& input);
/// Parts of the first mesh that is worth a run: parts_that_resolve its contacts, and that leave no
/// mesh_doubt; `used` is of `input`.
int parts_at_first(const Case& input, const ResolvedSettings& used);

/// The shortest contact or separation that the mesh of a case can show, s: the waves of a shorter
/// one have fewer than 3.5 cells. 0 for a rigid beam and for meshes of the caller's own.
double shortest_contact_shown(const Case& input);

/// Why a sub-impact is not shown by the mesh, none if it is: its contact, or the separation after
/// it, is too short; or it lasts to the end, on a mesh with fewer than parts_that_resolve, where
/// two runs may both have missed its end; or Hermite elements have yielded under the striker, where
/// meshes agree on contacts that the beam opens (validation/truth/mesh).
std::optional<Reason> unresolved_contact(const Case& input, const Result& result, std::size_t i);

/// Why the mesh shows no sub-impact rightly, none if it may: what it adds to the mass that the
/// striker moves at once is as heavy as a fifth of the striker, or the strike is less than six
/// cells from an end. A beam with rotary inertia and without shear opposes a mass of its own to a
/// blow, 2 rho A r away from its ends.
std::optional<Reason> mesh_doubt(const Case& input, const ResolvedSettings& used);

/// The first-order part of the error that cells with free ends leave in an event time: s, for an
/// event at `time` (s) of a run with this `contact_time` (s, ResolvedSettings). 0 for other meshes,
/// for supported ends and in Euler-Bernoulli theory. Derived in docs/theory.md, "Cells".
double free_end_error(const Case& input, double contact_time, double time);

}  // namespace subimpact
