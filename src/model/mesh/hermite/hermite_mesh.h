#pragma once

#include <array>
#include <span>
#include <vector>

#include "model/mesh/hermite/hermite_elements.h"
#include "subimpact/model/mesh/beam_mesh.h"

namespace subimpact {

/// Cubic Hermite elements: displacement and slope at the nodes, fourth order in their length,
/// 2 Gauss points per element as sections (docs/theory.md, "Hermite elements").
///
/// Unknowns, node by node (HermiteNodes): w and h t, both in m, with h = l/n.
class HermiteMesh final : public BeamMesh {
 public:
  static constexpr std::size_t fewest_elements = HermiteNodes::fewest_elements;

  /// `position` is the struck point as a fraction of the length, `n_elements` counts those of the
  /// whole beam. Throws std::invalid_argument as HermiteNodes does.
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
  std::string description() const override;

 private:
  static constexpr std::size_t none = HermiteNodes::none;

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

  HermiteMesh(const Beam& beam, double position, HermiteNodes nodes);

  HermiteElement element(std::size_t e) const;
  bool is_chain() const;
  void gather_elements();
  void place_sections(std::size_t e, double left);
  void assemble_mass();
  void assemble_moment();
  SparseFunctional of_element(std::size_t element,
                              const HermiteElement::Coefficients& coefficients) const;

  HermiteNodes nodes_;
  double slope_unit_;  // h, m
  double mass_per_length_;
  double rotary_inertia_;
  std::vector<Run> runs_;
  std::vector<Single> singles_;
};

}  // namespace subimpact
