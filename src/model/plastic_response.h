#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "model/mixed_mesh.h"

namespace subimpact {

/// What plastic curvature at one node of a mixed mesh does to moments and displacements around it,
/// with inertia as in MixedSections: linear, and constant in time. One column per node, computed
/// when its node first flows; entries that have decayed below 1e-12 are left out.
class PlasticResponse {
 public:
  explicit PlasticResponse(const MixedMesh& mesh);

  /// Quantities per unit of p (rad) or b (rad): elastic curvature M/(E I) at sections, 1/m, and
  /// displacement of unknowns, m.
  enum Kind { curvature_of_p, curvature_of_b, shift_of_p, shift_of_b, curvature_at_rest, n_kinds };
  struct Column {
    std::size_t first = 0, size = 0;  ///< sections
    /// Unknowns at the same nodes, of which the first `skipped` entries of a kind have none.
    std::size_t first_unknown = 0, n_unknowns = 0, skipped = 0;
    std::shared_ptr<const std::vector<double>> values;  ///< of each kind, one after another
    const double* of(Kind kind) const { return values->data() + kind * size; }
    double at(Kind kind, std::size_t section) const {
      return section - first < size ? of(kind)[section - first] : 0.0;
    }
  };
  /// The column of a section of the mesh.
  const Column& column(std::size_t section) {
    if (columns_[section].size == 0) columns_[section] = make(section);
    return columns_[section];
  }

 private:
  Column make(std::size_t section);
  Column computed(std::size_t section) const;
  bool is_far_from_ends(const Column& column) const;
  // Displacements and elastic curvatures of the whole mesh.
  struct Response {
    std::vector<double> shift, curvature;
  };
  Response respond(std::size_t section, double q, double r, double p) const;

  const MixedMesh& mesh_;
  std::unique_ptr<MassSolver> mass_;
  std::vector<Column> columns_;
  // One far from ends, before the strike and after it; others there are the same, shifted.
  struct Pattern {
    std::size_t section;
    Column column;
  };
  std::array<std::optional<Pattern>, 2> patterns_;
};

}  // namespace subimpact
