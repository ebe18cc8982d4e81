#pragma once

#include "subimpact/case/case.h"

namespace subimpact {

/// Refuses numbers that are possible one by one but whose products overflow, vanish or lose all
/// digits: each number of a case, and mass, stiffness, frequency and energy of its bodies. Throws
/// InvalidCase for the key that is farthest from one.
void check_scales(const Case& input);

}  // namespace subimpact
