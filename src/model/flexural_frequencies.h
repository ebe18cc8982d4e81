#pragma once

#include <cstddef>
#include <vector>

#include "subimpact/model/scene.h"

namespace subimpact {

/// The first `n` natural bending frequencies (rad/s) of the free-free beam, rigid modes left out,
/// in the beam's own theory.
///
/// Rayleigh beam: with B = beta^4 = rho A omega^2 l^4/(E I), r^2 = I/(A l^2),
/// a^2 = [B r^2 + sqrt(B^2 r^4 + 4 B)]/2 and b = beta^2/a, the frequency equations are
///
///     symmetric      b^3 sin(a/2) + a^3 cos(a/2) tanh(b/2) = 0
///     antisymmetric  a^3 sin(a/2) - b^3 cos(a/2) tanh(b/2) = 0
///
/// (r = 0: Euler-Bernoulli). Roots alternate between the two.
std::vector<double> free_free_frequencies(const Beam& beam, std::size_t n);

/// beta_1..beta_n of the same, for a given slenderness r = sqrt(I/A)/l.
std::vector<double> free_free_wave_numbers(double slenderness, std::size_t n);

}  // namespace subimpact
