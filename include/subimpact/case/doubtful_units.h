#pragma once

#include <string>
#include <vector>

#include "subimpact/case/case.h"

namespace subimpact {

/// Values that are probably given in another unit than that of the case file, such as lengths in mm
/// or stresses in MPa: one sentence per key, with the value, what makes it doubtful and what to
/// write if that unit was meant. Empty for every plausible scene; a doubtful one can be run all the
/// same.
std::vector<std::string> doubtful_units(const Case& input);

}  // namespace subimpact
