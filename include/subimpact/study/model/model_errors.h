#pragma once

#include <optional>

#include "subimpact/case/case.h"
#include "subimpact/simulate/observer.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// How far the model of a run may be from the body itself, for the end of the first contact parted
/// by more than 1 um, largest force, striker's velocity at the end and permanent set:
///
///   - shear: the difference that it makes on a coarse mesh; with shear, that of a shear
///     coefficient larger by 2 % (exact for thin rectangles instead of Cowper's);
///   - contact law: the largest difference that yield pressures of 1.6 Y (ball) or 1.67 Y (line)
///     and 2.8 Y make, under a cylinder also plane stress, under a ball a mid-plane 3 % deeper;
///     with other laws, that of the one choose_scene() would take;
///   - width: of a beam that yields, that of 2 Y/sqrt(3) in the sections, held sideways;
///   - finite rotations: the square of the largest rotation, relative, of those up to the parting
///   and the peak;
///   - stretching, between held ends: (w/2r)^2, relative, of the largest deflection w and the
///     radius of gyration r (the tension of a pinned beam over its buckling load); half of it in
///     times;
///   - thin openings: how far the parting moves if openings are wrong by as much as the parts above
///     change that opening;
///   - hinge length: a hinge of rotation theta over the height h in place of a point: a set smaller
///     by theta h/8.
///
/// The differences come from runs of the same scene on a coarse mesh, with a quarter of the counted
/// work of the run and those beside it, at least some 4e6. A part that could not be computed has no
/// number, as where even the coarsest mesh would take 20 times that. Nothing where `progress` stops
/// it, for runs that did not complete or without contact, on an earlier state, on a rigid beam or
/// with parts of the caller's own.
std::optional<ModelErrors> model_errors(const Case& input, const Result& result,
                                        const Progress& progress = {});

}  // namespace subimpact
