#pragma once

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// What a mesh needs to resolve short contacts. A contact or a separation of duration T sends out
/// bending waves of the length
///
///     lambda = 2 pi sqrt(c r T/pi),  c r = sqrt(E I/(rho A)).
///
/// A part of the mesh stands for one cell, an element for two, a spectral element for eight.

/// Parts over the whole length of which eight cells lie in the waves of contacts as short as
/// `contact_time` (s), from 64 cells to `most_cells`.
int parts_that_resolve(const Case& input, double contact_time, double most_cells = 1e9);
/// The most that the program chooses without having run the case.
constexpr double most_cells_at_first = 2000.0;

/// The shortest contact or separation that the mesh of a case can show, s: the waves of a shorter
/// one have fewer than 3.5 cells. On such a mesh the striker meets the mass of a node rather than
/// the beam, and coarser meshes agree with each other on a contact that does not end so in the
/// beam. 0 for a rigid beam and for meshes of the caller's own.
double shortest_contact_shown(const Case& input);

/// Sets first_unresolved in the error estimate of a result to its first sub-impact that the mesh
/// does not show: one with a contact, or a separation after it, that is too short; a contact that
/// lasts to the end, whose end two runs may both have missed on a mesh with fewer than
/// parts_that_resolve.
void doubt_unresolved_contacts(Result& result, const Case& input);

}  // namespace subimpact
