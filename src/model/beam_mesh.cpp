#include "subimpact/model/beam_mesh.h"

#include <algorithm>

#include "numerics/lanes.h"

namespace subimpact {

double SparseFunctional::of_all(std::span<const double> unknowns) const {
  return dot(dense.data(), unknowns.data(), dense.size());
}

std::size_t BeamMesh::stiffness_bandwidth() const {
  std::size_t bandwidth = 0;
  for (std::size_t i = 0; i < n_sections(); ++i) {
    bandwidth = std::max(bandwidth, section_stencil(i).coefficients.size() - 1);
  }
  return bandwidth;
}

double BeamMesh::curvature(std::size_t section, std::span<const double> unknowns) const {
  const SectionStencil row = section_stencil(section);
  double sum = 0.0;
  for (std::size_t i = 0; i < row.coefficients.size(); ++i) {
    sum += row.coefficients[i] * unknowns[row.first + i];
  }
  return sum;
}

SparseFunctional BeamMesh::curvature_functional(std::size_t section) const {
  const SectionStencil row = section_stencil(section);
  SparseFunctional functional;
  for (std::size_t i = 0; i < row.coefficients.size(); ++i) {
    functional.terms.push_back({row.first + i, row.coefficients[i]});
  }
  return functional;
}

void BeamMesh::add_stiffness(std::span<const double> tangents, BandedMatrix& result) const {
  for (std::size_t i = 0; i < n_sections(); ++i) {
    const SectionStencil row = section_stencil(i);
    const double factor = weights_[i] * tangents[i];
    for (std::size_t a = 0; a < row.coefficients.size(); ++a) {
      for (std::size_t b = a; b < row.coefficients.size(); ++b) {
        result.at(row.first + a, row.first + b) +=
            factor * row.coefficients[a] * row.coefficients[b];
      }
    }
  }
}

}  // namespace subimpact
