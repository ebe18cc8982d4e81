#pragma once

#include <complex>
#include <string>

namespace subimpact {

/// R(z) of an explicit or diagonally implicit Runge-Kutta table: y' = lambda y goes from y to R(h
/// lambda) y in one step. On an undamped oscillation, |R(i omega h)| is the growth of its
/// amplitude. Throw std::invalid_argument for an unknown table.
std::complex<double> explicit_stability(const std::string& table, std::complex<double> z);
std::complex<double> dirk_stability(const std::string& table, std::complex<double> z);

}  // namespace subimpact
