#pragma once

#include <array>
#include <span>
#include <vector>

#include "model/beam_mesh.h"

namespace subimpact {

/// Cubic Hermite elements: displacement and slope at the nodes, fourth order in the element length.
///
/// Inside an element of length a the displacement is the cubic through both nodes' values and
/// slopes, so the curvature is linear,
///
///     kappa = (t_1 - t_0)/a + eta [6 (w_0 - w_1)/a^2 + 3 (t_0 + t_1)/a],  t = w',  eta in [-1, 1]
///
/// and known (with the law that makes a moment of it) at 2 to 4 Gauss points, which are the
/// sections: two integrate the elastic stiffness exactly. The mass is consistent, integral of
/// rho A N^T N + J N'^T N', and banded with three entries beside the diagonal.
///
/// Unknowns, node by node: w and h t, both in m, with h = l/n. Supports leave out what they hold: w
/// at a pinned end, both at a clamped one, the slope in the middle of the half model. There is a
/// node at the strike; to its left and right elements are equal among themselves, and their numbers
/// share n as the strike shares the length.
class HermiteMesh final : public BeamMesh {
 public:
  enum class Extent { whole, half };

  static constexpr std::size_t fewest_elements = 4;

  /// `position` is the struck point as a fraction of the length, `n_elements` counts those of the
  /// whole beam. Throws std::invalid_argument for fewer than 4 elements, other than 2, 3 or 4
  /// sections an element, a strike on a support, a half model of an odd number of elements, of
  /// unlike ends or struck off mid-span.
  HermiteMesh(const Beam& beam, double position, std::size_t n_elements,
              std::size_t sections_per_element, Extent extent);

  void curvatures(std::span<const double> unknowns, std::span<double> kappa) const override;
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override;
  SectionStencil section_stencil(std::size_t section) const override;
  /// Bisected to 5e-6 from above.
  double highest_frequency(double bending_stiffness) const override;
  /// In closed form if all elements are equal and not one end is free, the other clamped (see
  /// hermite_chain_modes).
  NaturalModes natural_modes(double bending_stiffness) const override;
  /// If they have the closed form, of up to 2000 unknowns.
  bool prefers_modes() const override;
  std::string description() const override;

 private:
  // Equal elements in a row, and the factors of their curvature.
  struct Run {
    std::size_t first, end;   // elements
    double length;            // a, m
    double mean;              // of the difference of slopes: 1/(a h)
    double of_displacements;  // 6/a^2
    double of_slopes;         // 3/(a h)
  };
  // The four unknowns of an element, w_0, h t_0, w_1, h t_1.
  using Local = std::array<double, 4>;
  struct Held {
    bool displacement, slope;
  };
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  Held held(std::size_t node) const;
  std::size_t unknown(std::size_t node, bool slope) const;  // none where held
  std::array<std::size_t, 4> unknowns_of(std::size_t element) const;
  const Run& run_of(std::size_t element) const;
  bool has_equal_elements() const;
  Local local_values(std::size_t element, std::span<const double> unknowns) const;
  void add_local(std::size_t element, const Local& values, std::span<double> result) const;
  double highest_element_frequency_squared(double bending_stiffness) const;
  void assemble_mass();
  void place_sections();
  template <std::size_t points>
  void curvatures_with(const double* unknowns, double* kappa) const;
  template <std::size_t points>
  void bending_forces_with(const double* moments, std::span<double> forces) const;

  std::size_t n_elements_whole_;
  std::size_t n_elements_;  // of the part modelled
  double slope_unit_;       // h, m
  double mass_per_length_;
  double rotary_inertia_;
  std::array<EndSupport, 2> ends_;
  std::vector<Run> runs_;
  std::vector<double> points_;         // eta of the sections of an element
  std::vector<double> point_weights_;  // their shares of its length
  struct Row {
    std::size_t first, size;
    Local coefficients;
  };
  std::vector<Row> rows_;  // of B
};

}  // namespace subimpact
