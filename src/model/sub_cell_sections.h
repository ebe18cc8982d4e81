#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "model/mixed_mesh.h"
#include "model/moment_law.h"

namespace subimpact {

/// The sections within the cells of a mixed mesh, at which plastic curvature is known; those of a
/// cell are made when a moment at one of its nodes first leaves the elastic range. Next to a strike
/// or a clamped end there are five, at which the curvature's cusp, x^-1/2, is integrated exactly;
/// in other cells two.
///
/// A cell is named by its index among those made. The moment is linear between a cell's two nodes.
/// Moments in M_y, curvatures in kappa_y.
class SubCellSections {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  SubCellSections(const MixedMesh& mesh, SectionLaw law);

  /// The index of a cell of the mesh, or none.
  std::size_t find(std::size_t cell) const { return index_of_[cell]; }
  std::size_t make(std::size_t cell);
  std::size_t n_made() const { return cells_.size(); }
  std::size_t cell_of(std::size_t index) const { return cells_[index].cell; }

  using Ends = std::array<double, 2>;  ///< of a cell: its two nodes
  bool flows(std::size_t index, const Ends& moments) const;
  /// Whether every section is short of its full plastic moment.
  bool is_inside(std::size_t index, const Ends& moments) const;
  /// The part of a step of the moments that leaves every section short of its full plastic moment.
  double part_of_step(std::size_t index, const Ends& moments, const Ends& step) const;
  static double part_of_step(double moment, double step);

  /// The flow since the last commit, p and b of MixedSections (kappa_y m) at both nodes, and their
  /// derivatives by the moments at both.
  struct Flow {
    Ends p{}, b{};
    std::array<Ends, 2> p_slope{}, b_slope{};
  };
  Flow flow(std::size_t index, const Ends& moments) const;
  /// Advances histories to these moments. Returns whether anything flowed.
  bool commit(std::size_t index, const Ends& moments);
  /// The histories of all cells made.
  void exchange(Snapshot& snapshot);

  /// Moments at both nodes between which nothing flows in the cell.
  struct Window {
    double low = -1.0, high = 1.0;
  };
  const Window& window(std::size_t index) const { return cells_[index].window; }

  /// Energies in the cell; the elastic one is in addition to that of the moment.
  BendingEnergies energies(std::size_t index, const Ends& moments) const;
  /// Energies while nothing flows in the cell, for any moments.
  const BendingEnergies& energies_at_rest(std::size_t index) const;
  /// Stress (Pa) of the outermost fibre away from the striker, at the section nearest to node 2.
  double outer_stress(std::size_t index, const Ends& moments) const;

 private:
  struct Section {
    MomentLaw law;
    Ends hat;             // of the nodes, there
    Ends weight, bubble;  // of p and b, m

    double moment(const Ends& ends) const { return hat[0] * ends[0] + hat[1] * ends[1]; }
  };
  struct Cell {
    std::size_t cell, first, end;  // sections
    Window window = {};
    mutable std::optional<BendingEnergies> at_rest =
        {};  // computed when first needed after each flow
  };
  std::span<const Section> sections_of(std::size_t index) const {
    const Cell& cell = cells_[index];
    return std::span(sections_).subspan(cell.first, cell.end - cell.first);
  }
  void add(double at, double weight, double length);
  double curvature(const Section& section, double moment) const;  // 1/m
  BendingEnergies energies(const Section& section, double moment) const;

  const MixedMesh& mesh_;
  SectionLaw law_;
  double yield_curvature_;
  std::vector<std::size_t> index_of_;
  std::vector<Cell> cells_;
  std::vector<Section> sections_;
  mutable SectionHistory reached_;  // work space
};

}  // namespace subimpact
