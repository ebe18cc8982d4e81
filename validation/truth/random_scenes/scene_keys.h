#pragma once

#include "draws.h"
#include "subimpact/case/case.h"

namespace subimpact::scenes {

/// Adds two or more of: gravity, a fall from a height, a gap, a stop, a moving beam, loads,
/// springs, a bedding, equilibrium at the start. What they are worth follows from the strike drawn
/// before.
void draw_scene_keys(Random& random, Case& input);

/// The keys added, in words: ", gravity, springs".
std::string scene_keys_of(const Case& input);

}  // namespace subimpact::scenes
