#include "subimpact/model/mesh/beam_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "numerics/lanes.h"

namespace subimpact {

double SparseFunctional::of_all(std::span<const double> unknowns) const {
  return dot(dense.data(), unknowns.data(), dense.size());
}

void SparseFunctional::add(double factor, const SparseFunctional& other) {
  for (const Term& term : other.terms) {
    const auto same =
        std::ranges::find_if(terms, [&](const Term& t) { return t.unknown == term.unknown; });
    if (same == terms.end()) {
      terms.push_back({term.unknown, factor * term.coefficient});
    } else {
      same->coefficient += factor * term.coefficient;
    }
  }
  std::erase_if(terms, [](const Term& term) { return term.coefficient == 0.0; });
}

void SparseFunctional::add_square(double factor, BandedMatrix& to) const {
  for (const Term& a : terms) {
    for (const Term& b : terms) {
      if (b.unknown < a.unknown) continue;
      to.at(a.unknown, b.unknown) += factor * a.coefficient * b.coefficient;
    }
  }
}

std::size_t BeamMesh::nearest_section(double x) const {
  const auto nearest =
      std::ranges::min_element(positions_, {}, [x](double at) { return std::abs(at - x); });
  return static_cast<std::size_t>(nearest - positions_.begin());
}

void BeamMesh::add_stencil(std::size_t first, std::span<const double> coefficients) {
  stencils_.push_back({first, stencil_coefficients_.size(), coefficients.size()});
  stencil_coefficients_.insert(stencil_coefficients_.end(), coefficients.begin(),
                               coefficients.end());
}

BeamMesh::SectionStencil BeamMesh::section_stencil(std::size_t section) const {
  const auto [first, begin, size] = stencils_.at(section);
  return {first, std::span(stencil_coefficients_).subspan(begin, size)};
}

std::size_t BeamMesh::stiffness_bandwidth() const {
  std::size_t bandwidth = shear_stiffness_.half_bandwidth();
  for (std::size_t i = 0; i < n_sections(); ++i) {
    bandwidth = std::max(bandwidth, section_stencil(i).coefficients.size() - 1);
  }
  return bandwidth;
}

double BeamMesh::curvature(std::size_t section, std::span<const double> unknowns) const {
  const SectionStencil row = section_stencil(section);
  return std::inner_product(row.coefficients.begin(), row.coefficients.end(),
                            unknowns.subspan(row.first).begin(), 0.0);
}

SparseFunctional BeamMesh::curvature_functional(std::size_t section) const {
  const SectionStencil row = section_stencil(section);
  SparseFunctional functional;
  for (std::size_t i = 0; i < row.coefficients.size(); ++i) {
    functional.terms.push_back({row.first + i, row.coefficients[i]});
  }
  return functional;
}

BandedMatrix BeamMesh::slope_form() const {
  const std::vector<Slope> all = slopes();
  BandedMatrix form(all.empty() ? 0 : n_unknowns(), all.empty() ? 0 : stiffness_bandwidth());
  for (const Slope& slope : all) slope.value.add_square(slope.weight, form);
  return form;
}

std::string BeamMesh::described(std::size_t n, const char* parts) const {
  return std::to_string(n) + " " + parts + (symmetric_ ? ", one half by symmetry" : "");
}

void BeamMesh::add_shear_forces(std::span<const double> unknowns, std::span<double> forces) const {
  shear_stiffness_.subtract_product(unknowns, forces);
}

void BeamMesh::internal_forces(std::span<const double> unknowns, std::span<const double> moments,
                               std::span<double> forces) const {
  bending_forces(moments, forces);
  if (shears()) add_shear_forces(unknowns, forces);
}

double BeamMesh::shear_energy(std::span<const double> unknowns) const {
  return shear_stiffness_.size() > 0 ? 0.5 * shear_stiffness_.quadratic_form(unknowns) : 0.0;
}

void BeamMesh::add_stiffness(std::span<const double> tangents, BandedMatrix& result) const {
  result.add(1.0, shear_stiffness_);
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
