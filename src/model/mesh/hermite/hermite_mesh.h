#pragma once

#include <array>
#include <span>
#include <vector>

#include "model/mesh/element_mesh.h"
#include "numerics/gauss.h"

namespace subimpact {

/// One cubic Hermite element of length a with the unknowns w_0, h t_0, w_1, h t_1, all in m: the
/// displacements and slopes t = w' at its nodes, with h, the slope unit, a length that a mesh
/// chooses. Its sections are two Gauss points, each for half the length, which integrate the
/// elastic stiffness exactly: the curvature is linear in eta, from -1 to 1 along the element.
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

/// Cubic Hermite elements: displacement and slope at the nodes, fourth order in their length,
/// 2 Gauss points per element as sections (docs/theory.md, "Hermite elements").
///
/// Unknowns, node by node (ElementNodes): w and h t, both in m, with h = l/n.
class HermiteMesh final : public ElementMesh {
 public:
  static constexpr std::size_t fewest_elements = 4;

  /// `position` is the struck point as a fraction of the length, `n_elements` counts those of the
  /// whole beam. Throws std::invalid_argument as ElementNodes does.
  HermiteMesh(const Beam& beam, double position, std::size_t n_elements, Extent extent);

  void curvatures(std::span<const double> unknowns, std::span<double> kappa) const override;
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override;
  std::optional<SparseFunctional> displacement_at(double x) const override;
  std::optional<SparseFunctional> rotation_at(double x) const override;
  std::vector<Slope> slopes() const override;
  /// Found by bisection to 5e-6, from above.
  double highest_frequency(double bending_stiffness) const override;
  /// In closed form if all elements are equal, unless one end is free and the other
  /// clamped (see hermite_chain_modes).
  NaturalModes natural_modes(double bending_stiffness) const override;
  bool has_closed_modes() const override;
  /// True if the modes have the closed form, up to 2000 unknowns.
  bool prefers_modes() const override;
  std::string description() const override {
    return described(nodes_.n_elements_whole(), "Hermite elements of 2 sections");
  }

 private:
  // Equal elements in a row with all their unknowns, in order.
  struct Run {
    std::size_t size;
    std::size_t first_unknown, first_section;
    HermiteElement element;
  };
  // An element with held unknowns.
  struct Single {
    std::array<std::size_t, 4> unknowns;
    std::size_t first_section;
    HermiteElement element;
  };

  HermiteElement element(std::size_t e) const;
  bool is_chain() const;
  void gather_elements();
  // Unknowns of displacement and slope at the left node, then at the right one.
  std::array<std::size_t, 4> unknowns_of(std::size_t element) const;
  // The element that contains x (m), and where in it, from 0 to 1.
  std::pair<std::size_t, double> element_at(double x) const;
  void place_sections(std::size_t e, double left);
  void assemble_mass();
  void assemble_moment();
  SparseFunctional of_element(std::size_t element,
                              const HermiteElement::Coefficients& coefficients) const;

  double slope_unit_;  // h, m
  double mass_per_length_;
  double rotary_inertia_;
  std::vector<Run> runs_;
  std::vector<Single> singles_;
};

}  // namespace subimpact
