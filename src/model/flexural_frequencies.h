#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "subimpact/model/scene.h"

namespace subimpact {

/// The first `n` natural bending frequencies (rad/s) of the beam with its ends, rigid modes left
/// out, in the beam's own theory (docs/theory.md, "Beam"). Timoshenko's is taken to the first order
/// in r^2 and shear: r^2 (1 + E/(k G)) in place of r^2.
std::vector<double> flexural_frequencies(const Beam& beam, std::size_t n);

/// beta_1..beta_n of the same, for a given slenderness r = sqrt(I/A)/l.
std::vector<double> flexural_wave_numbers(double slenderness, const std::array<EndSupport, 2>& ends,
                                          std::size_t n);

}  // namespace subimpact
