#pragma once

#include <array>
#include <string>

namespace subimpact {

/// The larger modulus of the eigenvalues of a real 2 x 2 matrix.
double spectral_radius(const std::array<std::array<double, 2>, 2>& m);

/// Stability of coefficients for an undamped oscillation q'' = -omega^2 q in steps of omega h = y.

/// Spectral radius of a step of a Runge-Kutta-Nystroem table on (omega q, v). Throws
/// std::invalid_argument for an unknown table.
double nystrom_growth(const std::string& table, double y);

/// Largest modulus of a root of sum_j alpha_j zeta^j = i y zeta^k, the backward differentiation
/// formula of order k = 1 to 5 on y' = i omega y at equal steps.
double bdf_growth(int order, double y);

}  // namespace subimpact
