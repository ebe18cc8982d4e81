#pragma once

#include <limits>

#include "subimpact/case/case.h"

namespace subimpact::predictability {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The published strike on 501 cells, 8 ms: `exponential` where sections stay elastic, else
/// `nystrom`.
Case paper_strike(SectionKind section);

/// A strike on 101 cells over 0.3 first periods, drawn by its number: dimensions, material, masses,
/// velocity, position and ends about those of the published one. At least four contacts.
Case random_strike(int number, SectionKind section, BeamTheory theory);

}  // namespace subimpact::predictability
