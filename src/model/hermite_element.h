#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace subimpact {

/// The sections of a Hermite element, whose curvature is mean + eta half, eta in [-1, 1]: their
/// positions, their weights, and the curvature of each.
struct ElementRule {
  std::vector<double> points;   ///< eta
  std::vector<double> weights;  ///< shares of the element's length
  /// kappa of a section = of_curvature[0] mean + of_curvature[1] half.
  std::vector<std::array<double, 2>> of_curvature;

  std::size_t size() const { return points.size(); }
};

/// Gauss points: 2 to 4; two integrate the elastic stiffness exactly. Throws std::invalid_argument
/// for any other number.
ElementRule gauss_rule(std::size_t n);

/// The length that each element beside a hinge gives to the hinge, as a share of the element's
/// length.
constexpr double hinge_share = 0.05;

/// Two sections of an element with a hinge at its start, its end, or both, which has a section of
/// its own. With the hinge's share of the weights they integrate any quadratic and (not between two
/// hinges) x^(-1/2), x the distance from the hinge; and they determine a linear moment exactly, for
/// any section law: sum w of_curvature M = the means of M and of eta M for every linear M. See
/// docs/theory.md, "Hermite elements".
ElementRule rule_beside_hinges(bool at_start, bool at_end);

/// One cubic Hermite element of length a with the unknowns w_0, h t_0, w_1, h t_1, all in m: the
/// displacements and slopes t = w' at its nodes, with h, the slope unit, a length that a mesh
/// chooses. The curvature is linear,
///
///     kappa = (t_1 - t_0)/a + eta [6 (w_0 - w_1)/a^2 + 3 (t_0 + t_1)/a],  eta in [-1, 1].
struct HermiteElement {
  using Coefficients = std::array<double, 4>;  ///< of the four unknowns
  using Matrix = std::array<Coefficients, 4>;

  /// Both in m.
  HermiteElement(double a, double h);

  /// Of a section's curvature, whose parts are those of ElementRule::of_curvature, 1/m2.
  Coefficients curvature(const std::array<double, 2>& of_curvature) const;
  /// Of w and w' at z = x/a from 0 to 1.
  Coefficients displacement(double z) const;
  Coefficients slope(double z) const;
  /// integral of rho A N^T N + J N'^T N', kg.
  Matrix mass(double mass_per_length, double rotary_inertia) const;
  /// integral of rho A N, kg, and of rho A N x + J N' with its left node at x = `left`, kg m.
  Coefficients momentum(double mass_per_length) const;
  Coefficients moment(double mass_per_length, double rotary_inertia, double left) const;
  /// Square of the highest frequency of the element by itself, with springs on its slope unknowns
  /// (N/m), rad2/s2.
  double highest_frequency_squared(const ElementRule& rule, std::array<double, 2> springs,
                                   double bending_stiffness, const Matrix& mass) const;

  double length;      ///< a, m
  double slope_unit;  ///< h, m
  // What makes a curvature of the unknowns.
  double mean;              ///< of the difference of slopes: 1/(a h), 1/m2
  double of_displacements;  ///< 6/a^2, 1/m2
  double of_slopes;         ///< 3/(a h), 1/m2
};

}  // namespace subimpact
