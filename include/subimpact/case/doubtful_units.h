#pragma once

#include <string>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// Values that are probably given in another unit than that of the case file, such as lengths in mm
/// or stresses in MPa: one sentence per key, with the value, what makes it doubtful and what to
/// write if that unit was meant. Empty for every plausible scene; a doubtful one can still be run.
std::vector<std::string> doubtful_units(const Case& input);

/// What a run shows to lie beyond the model, one sentence each with its number and what to do;
/// empty if there is nothing:
///
/// - a beam thicker than a tenth of its length whose theory has no shear, or than a third with it;
/// - sections that turn by more than 0.1 rad: the model has small rotations;
/// - a beam held at both ends whose struck point moves by more than half the thickness: stretching,
///   which the model leaves out, stiffens such a beam;
/// - an indentation deeper than a tenth of the nose radius;
/// - under the law `hertz`, a pressure p_0 = 3 F/(2 pi a^2), a^2 = R lambda, of more than 1.6 times
///   the yield stress of the beam: the contact would yield (K. L. Johnson, Contact Mechanics, 6.1).
///
/// Rotations are those seen at separations and at the end of the run.
std::vector<std::string> beyond_the_model(const Case& input, const Result& result);

}  // namespace subimpact
