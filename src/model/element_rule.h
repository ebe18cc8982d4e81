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

/// Two sections of an element with a hinge at its start, its end, or both. Under a concentrated
/// force the moment has a peak; where it comes near the plastic moment, curvatures grow as the
/// inverse root of the distance and finally a hinge rotates. A linear curvature can represent
/// neither. So the node has a section of its own, and the two other sections have curvatures such
/// that
///
///     sum w M = mean of M,  sum w eta M = mean of eta M   for every linear M,
///
/// that is, the two unknowns of the element's curvature determine a linear moment from two sections
/// exactly, for any section law. With the hinge's share of the weights the three integrate any
/// quadratic, so that an elastic beam bends as it should under linear moments; the two alone
/// integrate x^(-1/2), x the distance from the hinge (not between two hinges).
ElementRule rule_beside_hinges(bool at_start, bool at_end);

}  // namespace subimpact
