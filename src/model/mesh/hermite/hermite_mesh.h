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
/// Unknowns, node by node (HermiteNodes): w and h t, both in m, with h = l/n. At a node with a
/// hinge, whose section is taken from the elements next to it (rule_beside_hinges): h t_-, w, h
/// t_+.
class HermiteMesh final : public BeamMesh {
 public:
  static constexpr std::size_t fewest_elements = HermiteNodes::fewest_elements;

  /// `position` is the struck point as a fraction of the length, `n_elements` counts those of the
  /// whole beam. Throws std::invalid_argument as HermiteNodes does.
  HermiteMesh(const Beam& beam, double position, std::size_t n_elements, Extent extent,
              bool hinges = false);

  void curvatures(std::span<const double> unknowns, std::span<double> kappa) const override;
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override;
  std::optional<SparseFunctional> displacement_at(double x) const override;
  std::optional<SparseFunctional> rotation_at(double x) const override;
  std::vector<Slope> slopes() const override;
  /// Found by bisection to 5e-6, from above.
  double highest_frequency(double bending_stiffness) const override;
  /// In closed form if all elements are equal, without hinges, unless one end is free and the other
  /// clamped (see hermite_chain_modes).
  NaturalModes natural_modes(double bending_stiffness) const override;
  bool has_closed_modes() const override;
  /// True if the modes have the closed form, up to 2000 unknowns.
  bool prefers_modes() const override;
  std::string description() const override;

 private:
  static constexpr std::size_t none = HermiteNodes::none;

  // Equal elements in a row with Gauss points and all their unknowns, in order.
  struct Run {
    std::size_t size;
    std::size_t first_unknown, first_section;
    HermiteElement element;
  };
  // An element with held unknowns, or next to a hinge.
  struct Single {
    std::array<std::size_t, 4> unknowns;
    std::size_t first_section;
    HermiteElement element;
    ElementRule rule;
  };
  struct Hinge {
    std::size_t section;
    std::size_t slope_before, slope_after;  // unknowns; none where held
    double inverse;                         // 1/(L h), L of the part modelled, 1/m2
  };

  HermiteMesh(const Beam& beam, double position, HermiteNodes nodes);

  HermiteElement element(std::size_t e) const;
  bool is_chain() const;
  void gather_elements();
  void place_element(std::size_t e, double left, const ElementRule& rule);
  void place_hinge(std::size_t node, double x);
  void add_row(std::span<const std::size_t> unknowns, std::span<const double> coefficients);
  double highest_element_frequency_squared(double bending_stiffness) const;
  void assemble_mass();
  void assemble_moment();
  SparseFunctional of_element(std::size_t element,
                              const HermiteElement::Coefficients& coefficients) const;
  void curvatures_in_runs(const double* unknowns, double* kappa) const;
  void bending_forces_in_runs(const double* moments, double* forces) const;

  HermiteNodes nodes_;
  double slope_unit_;  // h, m
  double mass_per_length_;
  double rotary_inertia_;
  ElementRule gauss_ = gauss_rule();
  std::vector<Run> runs_;
  std::vector<Single> singles_;
  std::vector<Hinge> hinges_;
};

}  // namespace subimpact
