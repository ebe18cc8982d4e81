#pragma once

/// The model of a strike, where the case leaves it open: theory of the beam and law of contact by
/// what the scene needs; and how far the real beam may be from it.

#include <string>
#include <vector>

#include "subimpact/case/case_keys.h"
#include "subimpact/simulate/observer.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// Chooses theory and contact law where `given` leaves them open, by the scene and the time it is
/// followed: the same with any mesh, method, rtol and error bars. Returns the keys that were
/// chosen.
///
///   - contact.law by the nose and the section: a cylinder on a solid flat beam is a `line`, a
///   ball,
///     and any nose on a round section, a `sphere` (from the mid-plane where the section is solid
///     and flat and the beam bends, else from a half-space); what these do not describe gets
///     `hertz` or `foundation`. Without striker.nose it is a cylinder.
///   - contact.yield_pressure by the depth of the dent, where the law has it.
///   - beam.theory with shear, unless two coarse runs show that it moves the end of the first
///     contact parted by more than 1 um by less than 5 us (accuracy.event_times, if smaller), and
///     largest force, final velocity and set by less than 1 %.
///   - model.mesh, where model.elements alone is given, by the theory. A given mesh that does not
///     have the theory chosen throws InvalidCase.
///   - beam.poisson 0.3, where theory or law need it.
///
/// Case::model_choice says why. simulate(Case) computes the case as it is, with the defaults of the
/// structs (no shear, `foundation`): call this first for what `subimpact run` computes.
std::vector<std::string> choose_scene(Case& input, const GivenKeys& given);

/// Poisson's ratio of a beam for which the case has none.
inline constexpr double usual_poisson = 0.3;

/// Sets Result::body_errors and those of sub-impacts: how far the real beam may be from the model
/// of a run, by the parts of docs/model.md, those in Case::assumed among them.
///
/// Most come from runs with one thing changed, on meshes of the run's own kind and with a sixth of
/// the counted work of the run and those beside it, at least some 4e6: to twice the time of the
/// parting for what is decided by then, which so does not depend on the end, and to the end. A
/// change is not known where such a run failed, lost a twentieth of the energy, has no such number,
/// or lies from the run itself by three times the change and by three tenths of all changes. None
/// exceeds what the energy allows.
///
/// Nothing is set where `progress` stops it, for runs that did not complete or without contact, on
/// an earlier state, and with parts of the caller's own.
void add_body_errors(const Case& input, Result& result, const Progress& progress = {});

}  // namespace subimpact
