#pragma once

/// The model of a strike, where the case leaves it open: theory of the beam and law of contact by
/// what the scene needs; and how far the real beam may be from it.

#include <string>
#include <vector>

#include "subimpact/case/case_keys.h"
#include "subimpact/simulate/observer.h"

namespace subimpact {

/// Chooses theory, contact law and Poisson's ratio where `given` leaves them open, by the scene and
/// the time it is followed: the same with any mesh, method, rtol and error bars (docs/model.md,
/// "The model that the program chooses"). Where model.elements alone is given, the theory decides
/// on model.mesh. Returns the keys that were chosen; Case::model_choice says why. Throws
/// InvalidCase for a given mesh that does not have the theory chosen.
///
/// simulate(Case) computes the case as it is, with the defaults of the structs (no shear,
/// `foundation`): call this first for what `subimpact run` computes.
std::vector<std::string> choose_scene(Case& input, const GivenKeys& given);

/// Poisson's ratio of a beam for which the case has none.
inline constexpr double usual_poisson = 0.3;

/// Sets Result::body_errors and those of sub-impacts: how far the real beam may be from the model
/// of a run, by the parts of docs/model.md, those in Case::assumed among them. Most come from
/// coarse runs with one thing changed, which take a sixth of the counted work of the run and those
/// beside it, at least some 4e6.
///
/// Nothing is set where `progress` stops it, for runs that did not complete or without contact, on
/// an earlier state, and with parts of the caller's own.
void add_body_errors(const Case& input, Result& result, const Progress& progress = {});

}  // namespace subimpact
