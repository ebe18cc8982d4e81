#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "model/element_grading.h"
#include "model/element_rule.h"
#include "subimpact/model/beam_mesh.h"

namespace subimpact {

/// Cubic Hermite elements: displacement and slope at the nodes, fourth order in the element length.
///
/// Inside an element of length a the displacement is the cubic through both nodes' values and
/// slopes, so the curvature is linear,
///
///     kappa = (t_1 - t_0)/a + eta [6 (w_0 - w_1)/a^2 + 3 (t_0 + t_1)/a],  t = w',  eta in [-1, 1]
///
/// and known (with the section law that gives the moment) at 2 to 4 Gauss points, which are the
/// sections: two integrate the elastic stiffness exactly. The mass is consistent, integral of rho A
/// N^T N + J N'^T N', and banded with three entries beside the diagonal.
///
/// Unknowns, node by node: w and h t, both in m, with h = l/n. Supports leave out what they hold: w
/// at a pinned end, both at a clamped one, the slope in the middle of the half model. There is a
/// node at the strike; to its left and right the numbers of elements share n as the strike shares
/// the length. Elements are equal on either side, or graded towards the strike.
///
/// **Hinges.** Under a force between bodies, and at a clamped end, a beam that yields bends most in
/// a single section, a plastic hinge: the slope is nearly discontinuous there. A mesh with hinges
/// has a slope on either side of those nodes, t_- and t_+, and a section of length L between them,
///
///     kappa = (t_+ - t_-)/L,  L = hinge_share (a_- + a_+),
///
/// which is taken from the elements beside it (rule_beside_hinges). Unknowns there: h t_-, w, h
/// t_+.
class HermiteMesh final : public BeamMesh {
 public:
  enum class Extent { whole, half };

  static constexpr std::size_t fewest_elements = 4;

  struct Options {
    ElementGrading grading;
    bool hinges = false;
  };

  /// `position` is the struck point as a fraction of the length, `n_elements` counts those of the
  /// whole beam. Throws std::invalid_argument for fewer than 4 elements, other than 2, 3 or 4
  /// sections per element, a strike on a support, a half model of an odd number of elements, of
  /// unlike ends or struck off mid-span.
  HermiteMesh(const Beam& beam, double position, std::size_t n_elements,
              std::size_t sections_per_element, Extent extent, const Options& options);
  HermiteMesh(const Beam& beam, double position, std::size_t n_elements,
              std::size_t sections_per_element, Extent extent)
      : HermiteMesh(beam, position, n_elements, sections_per_element, extent, Options{}) {}

  void curvatures(std::span<const double> unknowns, std::span<double> kappa) const override;
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override;
  SectionStencil section_stencil(std::size_t section) const override;
  std::optional<SparseFunctional> displacement_at(double x) const override;
  std::optional<SparseFunctional> rotation_at(double x) const override;
  /// Bisected to 5e-6 from above.
  double highest_frequency(double bending_stiffness) const override;
  /// In closed form if all elements are equal, none beside a hinge, and not one end is free, the
  /// other clamped (see hermite_chain_modes).
  NaturalModes natural_modes(double bending_stiffness) const override;
  bool has_closed_modes() const override;
  /// If they have the closed form, of up to 2000 unknowns.
  bool prefers_modes() const override;
  std::string description() const override;

  /// Of the elements from left to right, m.
  std::span<const double> element_lengths() const { return lengths_; }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  // Indices of a node's unknowns; none where held. The slopes are one but at a hinge.
  struct Node {
    std::size_t displacement, slope_before, slope_after;
  };
  using Local = std::array<double, 4>;

  // What makes a curvature of an element's unknowns w_0, h t_0, w_1, h t_1.
  struct Factors {
    double length;            // a, m
    double mean;              // of the difference of slopes: 1/(a h)
    double of_displacements;  // 6/a^2
    double of_slopes;         // 3/(a h)
    // Those of a section's curvature (ElementRule::of_curvature) on the unknowns.
    Local row(const std::array<double, 2>& of_curvature) const;
  };
  // Equal elements in a row with Gauss points and all their unknowns, in order.
  struct Run {
    std::size_t size;
    std::size_t first_unknown, first_section;
    Factors factors;
  };
  // An element with unknowns held, or beside a hinge.
  struct Single {
    std::array<std::size_t, 4> unknowns;
    std::size_t first_section;
    Factors factors;
    ElementRule rule;
  };
  struct Hinge {
    std::size_t section;
    std::size_t slope_before, slope_after;  // unknowns; none where held
    double inverse;                         // 1/(L h), L of the part modelled, 1/m2
  };

  Factors factors_of(double length) const;
  bool is_chain() const;
  bool is_hinge(std::size_t node) const;
  void place_nodes(double left_length, double right_length);
  void number_unknowns();
  void gather_elements(std::size_t sections_per_element);
  void place_element(std::size_t element, double left, const ElementRule& rule);
  void place_hinge(std::size_t node, double x);
  void add_row(std::span<const std::size_t> unknowns, std::span<const double> coefficients);
  std::array<std::size_t, 4> unknowns_of(std::size_t element) const;
  void add_local(const std::array<std::size_t, 4>& unknowns, const Local& values,
                 std::span<double> result) const;
  double frequency_squared(const Factors& factors, const ElementRule& rule,
                           std::array<double, 2> springs, double bending_stiffness) const;
  double highest_element_frequency_squared(double bending_stiffness) const;
  void assemble_mass();
  void assemble_moment();
  // The element that contains x (m), and where in it, from 0 to 1.
  std::pair<std::size_t, double> element_at(double x) const;
  SparseFunctional of_element(std::size_t element, const Local& coefficients) const;
  template <std::size_t points>
  void curvatures_in_runs(const double* unknowns, double* kappa) const;
  template <std::size_t points>
  void bending_forces_in_runs(const double* moments, double* forces) const;

  std::size_t n_elements_whole_;
  std::size_t n_elements_;  // of the part modelled
  double slope_unit_;       // h, m
  double mass_per_length_;
  double rotary_inertia_;
  std::array<EndSupport, 2> ends_;
  Options options_;
  double copies_;  // 2 where the mirrored half is folded in
  std::size_t struck_node_;
  std::vector<double> lengths_;
  std::vector<Node> nodes_;
  ElementRule gauss_;
  std::vector<Run> runs_;
  std::vector<Single> singles_;
  std::vector<Hinge> hinges_;
  struct Row {
    std::size_t first, size;
    Local coefficients;
  };
  std::vector<Row> rows_;  // of B
};

}  // namespace subimpact
