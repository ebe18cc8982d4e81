#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "numerics/gauss.h"
#include "subimpact/model/scene.h"

namespace subimpact {

/// One cubic Hermite element of length a with the unknowns w_0, h t_0, w_1, h t_1, all in m: the
/// displacements and slopes t = w' at its nodes, with h, the slope unit, a length that a mesh
/// chooses. The curvature is linear,
///
///     kappa = (t_1 - t_0)/a + eta [6 (w_0 - w_1)/a^2 + 3 (t_0 + t_1)/a],  eta in [-1, 1].
///
/// Its sections are two Gauss points, each for half the length, which integrate the elastic
/// stiffness exactly.
struct HermiteElement {
  using Coefficients = std::array<double, 4>;  ///< of the four unknowns
  using Matrix = std::array<Coefficients, 4>;

  static constexpr std::array<double, 2> eta{2.0 * gauss<2>.points[0] - 1.0,
                                             1.0 - 2.0 * gauss<2>.points[0]};

  /// Both in m.
  HermiteElement(double a, double h);

  /// kappa of the sections, 1/m, from the four unknowns.
  void curvatures(const double* q, double* kappa) const {
    const double mean_curvature = mean * (q[3] - q[1]);
    const double half = of_displacements * (q[0] - q[2]) + of_slopes * (q[1] + q[3]);
    for (std::size_t g = 0; g < eta.size(); ++g) kappa[g] = mean_curvature + eta[g] * half;
  }
  /// The sections' moments times their weights, summed with the coefficients of curvatures(), N.
  Coefficients of_moments(const double* moments, double copies) const {
    double sum = 0.0;
    double first_moment = 0.0;
    for (std::size_t g = 0; g < eta.size(); ++g) {
      sum += 0.5 * moments[g];
      first_moment += 0.5 * eta[g] * moments[g];
    }
    const double scale = copies * length;
    const double couple = scale * mean * sum;
    const double shear = scale * of_displacements * first_moment;
    const double slopes = scale * of_slopes * first_moment;
    return {-shear, couple - slopes, shear, -couple - slopes};
  }
  /// Coefficients (1/m2) of a section's curvature.
  Coefficients curvature(double at) const;
  /// Coefficients of w and w' at z = x/a from 0 to 1.
  Coefficients displacement(double z) const;
  Coefficients slope(double z) const;
  /// integral of rho A N^T N + J N'^T N', kg.
  Matrix mass(double mass_per_length, double rotary_inertia) const;
  /// integral of rho A N, kg, and of rho A N x + J N' with its left node at x = `left`, kg m.
  Coefficients momentum(double mass_per_length) const;
  Coefficients moment(double mass_per_length, double rotary_inertia, double left) const;
  /// Square of the highest frequency, rad2/s2, of the element alone.
  double highest_frequency_squared(double bending_stiffness, const Matrix& mass) const;

  double length;      ///< a, m
  double slope_unit;  ///< h, m
  // What makes a curvature of the unknowns.
  double mean;              ///< of the difference of slopes: 1/(a h), 1/m2
  double of_displacements;  ///< 6/a^2, 1/m2
  double of_slopes;         ///< 3/(a h), 1/m2
};

/// Where the nodes of a mesh of cubic Hermite elements lie, and which unknowns they have: node by
/// node the displacement w and the slope, but what supports hold (w at a pinned end, both at a
/// clamped one, the slope in the middle of a half model).
///
/// There is a node at the strike; to its left and right the numbers of elements share n as the
/// strike shares the length. Elements are equal on either side.
struct HermiteNodes {
  static constexpr std::size_t fewest_elements = 4;
  /// In place of the index of an unknown that a support holds.
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// Indices of a node's unknowns.
  struct Node {
    std::size_t displacement, slope;
  };

  /// `position` is the struck point as a fraction of the length, `n_elements` counts those of the
  /// whole beam, of which a `half` has one half. Throws std::invalid_argument for fewer than 4
  /// elements, a strike on a support, a half of an odd number, of unlike ends, struck off mid-span.
  HermiteNodes(const Beam& beam, double position, std::size_t n_elements, bool half);

  std::size_t n_elements() const { return lengths.size(); }  ///< of the part modelled
  std::size_t n_elements_whole() const { return half ? 2 * n_elements() : n_elements(); }
  const Node& struck_node() const { return nodes[struck]; }
  /// Unknowns of displacement and slope at the left node, then at the right one.
  std::array<std::size_t, 4> unknowns_of(std::size_t element) const;
  /// The element that contains x (m), and where in it, from 0 to 1.
  std::pair<std::size_t, double> element_at(double x) const;

  bool half;
  std::array<EndSupport, 2> ends;
  std::size_t struck = 0;       ///< index of the node under the strike
  std::vector<double> lengths;  ///< of the elements, m
  std::vector<Node> nodes;
  std::size_t n_unknowns = 0;

 private:
  void place(double left_length, double right_length, std::size_t n_elements);
  void number_unknowns();
};

}  // namespace subimpact
