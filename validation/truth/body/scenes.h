#pragma once

#include <cstdint>
#include <string>

namespace subimpact::body {

/// A strike of the kinds that people have, as a case file that leaves mesh and method open: free,
/// pinned, clamped beams and cantilevers, planes, rigid bodies, hollow sections; damped or not;
/// noses as balls, cylinders or given stiffness; loads, gravity, stops. Seed and number determine
/// it; kinds take turns.
std::string case_text(std::uint64_t seed, int number);

}  // namespace subimpact::body
