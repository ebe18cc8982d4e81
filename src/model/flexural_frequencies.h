#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "subimpact/model/scene.h"

namespace subimpact {

/// The first `n` natural bending frequencies (rad/s) of the beam with its ends, rigid modes left
/// out, in the beam's own theory.  Timoshenko's is taken to the first order in r^2 and shear: r^2
/// (1 + E/(k G)) in place of r^2.
///
/// Rayleigh beam: with B = beta^4 = rho A omega^2 l^4/(E I), r^2 = I/(A l^2),
/// a^2 = [B r^2 + sqrt(B^2 r^4 + 4 B)]/2 and b = beta^2/a, shapes over xi = x/l are combinations of
/// cos(a xi), sin(a xi), exp(-b xi) and exp(-b (1 - xi)), with two conditions at each end:
///
///     free     phi'' = 0,  phi''' + B r^2 phi' = 0
///     pinned   phi = 0,    phi'' = 0
///     clamped  phi = 0,    phi' = 0
///
/// (r = 0: Euler-Bernoulli). Frequencies are the roots of the determinant of the four.
std::vector<double> flexural_frequencies(const Beam& beam, std::size_t n);

/// beta_1..beta_n of the same, for a given slenderness r = sqrt(I/A)/l.
std::vector<double> flexural_wave_numbers(double slenderness, const std::array<EndSupport, 2>& ends,
                                          std::size_t n);

}  // namespace subimpact
