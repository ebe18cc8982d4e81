#include "subimpact/model/mesh/matrix_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/mesh/modes.h"
#include "model/rules.h"

namespace subimpact {
namespace {

class MatrixMesh final : public BeamMesh {
 public:
  explicit MatrixMesh(MeshMatrices&& given)
      : BeamMesh(given.mass.size(), given.mass.half_bandwidth(), false),
        description_(std::move(given.description)) {
    mass_ = std::move(given.mass);
    weights_ = std::move(given.weights);
    positions_ = std::move(given.positions);
    struck_point_ = std::move(given.struck_point);
    first_end_ = std::move(given.first_end);
    momentum_functional_.resize(n_unknowns());
    mass_.multiply(given.translation, momentum_functional_);
    beam_mass_ = std::inner_product(given.translation.begin(), given.translation.end(),
                                    momentum_functional_.begin(), 0.0);
    if (!given.is_held) translation_ = std::move(given.translation);
    std::vector<double> pressed(n_unknowns(), 0.0);
    struck_point_.add_to(pressed, 1.0);
    double most = -1.0;
    for (const MeshMatrices::Row& row : given.curvature) {
      add_stencil(row.first, row.coefficients);
      const std::size_t section = n_stored_++;
      const double bent = std::abs(curvature(section, pressed));
      if (bent > most) struck_section_ = section;
      most = std::max(most, bent);
    }
  }

  void curvatures(std::span<const double> unknowns, std::span<double> kappa) const override {
    for (std::size_t i = 0; i < kappa.size(); ++i) kappa[i] = curvature(i, unknowns);
  }
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override {
    std::ranges::fill(forces, 0.0);
    for (std::size_t i = 0; i < moments.size(); ++i) {
      const auto [first, row] = section_stencil(i);
      for (std::size_t k = 0; k < row.size(); ++k) {
        forces[first + k] -= weights_[i] * row[k] * moments[i];
      }
    }
  }
  double highest_frequency(double bending_stiffness) const override {
    const auto is_above = above_spectrum(*this, bending_stiffness);
    double above = 1.0;
    while (!is_above(above)) above *= 4.0;
    for (double factor = 0.25; factor < 0.999; factor = std::sqrt(factor)) {
      while (is_above(factor * above)) above *= factor;
    }
    return std::sqrt(above);
  }
  std::string description() const override { return description_; }

 private:
  std::string description_;
  std::size_t n_stored_ = 0;
};

}  // namespace

std::shared_ptr<const BeamMesh> mesh_of(MeshMatrices matrices) {
  const std::size_t n = matrices.mass.size(), n_sections = matrices.curvature.size();
  require(matrices.mass.half_bandwidth() <= 3,
          "mesh_of: the mass has a half bandwidth of {}; allowed: up to 3",
          matrices.mass.half_bandwidth());
  require(n > 0 && matrices.mass.cholesky_factor().has_value(),
          "mesh_of: the mass of {} unknowns is not positive definite", n);
  require(matrices.weights.size() == n_sections && matrices.positions.size() == n_sections,
          "mesh_of: {} weights and {} positions for {} rows of the curvature",
          matrices.weights.size(), matrices.positions.size(), n_sections);
  require(matrices.translation.size() == n, "mesh_of: a translation of {} entries for {} unknowns",
          matrices.translation.size(), n);
  for (std::size_t i = 0; i < n_sections; ++i) {
    check_row(i, matrices.curvature[i].first, matrices.curvature[i].coefficients, n);
  }
  check_functional("struck point", matrices.struck_point, n);
  check_functional("first end", matrices.first_end, n);
  return std::make_shared<MatrixMesh>(std::move(matrices));
}

}  // namespace subimpact
