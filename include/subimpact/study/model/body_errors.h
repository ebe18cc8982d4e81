#pragma once

#include "subimpact/case/case_keys.h"
#include "subimpact/simulate/observer.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// Sets Result::body_errors and those of sub-impacts: how far the real beam may be from the model
/// of a run, by the parts of docs/model.md. `given`: the keys of the user; what they and the
/// material leave open is a part.
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
void add_body_errors(const Case& input, Result& result, const GivenKeys& given = {},
                     const Progress& progress = {});

}  // namespace subimpact
