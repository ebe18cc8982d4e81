#pragma once

#include <array>
#include <vector>

#include "model/mesh/element_mesh.h"
#include "numerics/lanes.h"

namespace subimpact {

/// Elements of a beam whose sections shear, with polynomials of degree 4 for displacement w and
/// rotation phi of the sections (docs/theory/meshes.md, "Spectral elements"). Unknowns, node by
/// node (ElementNodes): w and r phi, in m, with the radius of gyration r.
///
/// Source: A. T. Patera, J. Comput. Phys. 54 (1984) 468, for the elements; O. C. Zienkiewicz et
/// al., Int. J. Num. Meth. Eng. 3 (1971) 275, for the reduced integration.
class SpectralMesh final : public ElementMesh {
 public:
  static constexpr std::size_t degree = 4;
  static constexpr std::size_t n_nodes = degree + 1;  // of an element
  static constexpr std::size_t fewest_elements = 2;
  /// Gauss-Lobatto points and weights on [0, 1].
  static const std::array<double, n_nodes> nodes;
  static constexpr std::array<double, n_nodes> node_weights = {
      1.0 / 20.0, 49.0 / 180.0, 16.0 / 45.0, 49.0 / 180.0, 1.0 / 20.0};

  /// `position` is the struck point as a fraction of the length. Throws std::invalid_argument as
  /// ElementNodes does, and for a beam without shear.
  SpectralMesh(const Beam& beam, double position, std::size_t n_elements, Extent extent);

  void curvatures(std::span<const double> unknowns, std::span<double> kappa) const override;
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override;
  void add_shear_forces(std::span<const double> unknowns, std::span<double> forces) const override;
  void internal_forces(std::span<const double> unknowns, std::span<const double> moments,
                       std::span<double> forces) const override;
  double shear_energy(std::span<const double> unknowns) const override;
  /// Polynomials of degree 4 in each element.
  std::optional<SparseFunctional> displacement_at(double x) const override {
    return interpolated(x, 0);
  }
  std::optional<SparseFunctional> rotation_at(double x) const override;
  std::vector<Slope> slopes() const override;
  double highest_frequency(double bending_stiffness) const override;
  NaturalModes natural_modes(double bending_stiffness) const override;
  bool has_closed_modes() const override;
  double closed_modes_work() const override;  // n^3/20, mostly a product of matrices
  std::string description() const override {
    return described(nodes_.n_elements_whole(), "spectral elements");
  }

 private:
  static constexpr std::size_t n_points = degree;  // Gauss points of an element

  using Values = std::array<double, 2 * n_nodes>;
  // What 1 m in an unknown of an element adds to the strains at its Gauss points: rows of shear
  // strains, then of curvatures (1/m), by unknowns, filled up with zeros; the columns, all strains
  // of an unknown; and what a strain has for a weight: kGA or 1 N m2 times the length (m).
  static constexpr std::size_t of_shear = 0, of_bending = n_points;  // first rows
  struct alignas(64) Strains {
    Strains(double length, double gyration, double shear_stiffness, double copies);
    std::array<std::array<double, 2 * n_lanes>, n_lanes> rows{};
    std::array<std::array<double, n_lanes>, 2 * n_nodes> columns;
    std::array<double, n_lanes> weights;
  };

  // Indices of an element's unknowns, node by node: w, r phi; `none` for those left out.
  struct Element {
    double length;     // m
    std::size_t side;  // of the strike
    std::array<std::size_t, 2 * n_nodes> unknowns;
    bool is_contiguous;  // one after the other, none held
  };
  // The unknowns of an element, in `values` unless they follow each other.
  static const double* read(const Element& element, const double* unknowns, Values& values);
  // Takes from the forces what the stresses of all elements do, of the strains from `first` to
  // before `end`, times the length that a point stands for; asks for them in order.
  template <std::size_t first, std::size_t end, class StressesOf>
  void add_stresses(StressesOf stresses_of, double* forces) const;
  Lanes strains_of(const Element& element, const double* unknowns) const;
  static void put_bending(const Strains& strains, const double* moments, double* stresses);
  // Fills all eight: put_bending() comes after it.
  void put_shear(const Element& element, const double* unknowns, double* stresses) const;

  void place_elements();
  void assemble_mass(const Beam& beam);
  void assemble_shear();
  void place_sections();
  // Lagrange's polynomials at x for the displacements (0) or the rotations r phi (1).
  SparseFunctional interpolated(double x, std::size_t which) const;

  std::vector<Element> elements_;
  std::vector<Strains> strains_;  // by side
  double gyration_, mass_per_length_;
  double shear_stiffness_per_length_;  // kGA, N
};

}  // namespace subimpact
