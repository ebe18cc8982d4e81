#include "model/mesh/sprung_mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "numerics/gauss.h"
#include "numerics/lanes.h"
#include "numerics/mass_solver.h"

namespace subimpact {
namespace {

// Bandwidth of the unknowns on which the motion of one point depends, largest for degree 4.
std::size_t bandwidth_of(const BeamMesh& mesh) {
  return std::min(std::max<std::size_t>(3, mesh.stiffness_bandwidth()), mesh.n_unknowns() - 1);
}

}  // namespace

SprungMesh::SprungMesh(std::shared_ptr<const BeamMesh> other, const Beam& beam, std::size_t n_parts,
                       bool one_point)
    : BeamMesh(*other), other_(std::move(other)), springs_(n_unknowns(), bandwidth_of(*other_)) {
  if (!other_->displacement_at(0.0) || !other_->modal_stiffness().empty()) {
    throw std::invalid_argument("springs: a mesh without displacement_at(), or in natural modes");
  }
  translation_.clear();
  ground_force_.assign(n_unknowns(), 0.0);
  ground_moment_.assign(n_unknowns(), 0.0);
  for (const Spring& spring : beam.springs) {
    if (spring.one_sided) continue;
    const double x = spring.position * beam.length;
    add_spring(x, spring.stiffness, beam.length);
    std::vector<double> unit(n_unknowns(), 0.0), response;
    other_->displacement_at(symmetric() ? std::min(x, beam.length - x) : x)->add_to(unit, 1.0);
    response = unit;
    BandedSolver(mass_).solve(response);
    frequency_squared_ += spring.stiffness * dot(unit.data(), response.data(), n_unknowns());
  }
  const double part = beam.length / static_cast<double>(n_parts);
  for (std::size_t i = 0; i < n_parts && beam.foundation > 0.0; ++i) {
    const auto first = static_cast<double>(i);
    for (std::size_t k = 0; k < (one_point ? 1 : 4); ++k) {
      const double at = one_point ? 0.5 : gauss<4>.points[k];
      const double weight = one_point ? 1.0 : gauss<4>.weights[k];
      add_spring((first + at) * part, weight * part * beam.foundation, beam.length);
    }
  }
  BandedMatrix sum(n_unknowns(),
                   std::max(shear_stiffness_.half_bandwidth(), springs_.half_bandwidth()));
  sum.add(1.0, springs_);
  sum.add(1.0, shear_stiffness_);
  shear_stiffness_ = std::move(sum);
  frequency_squared_ += beam.foundation / beam.mass_per_length();
}

void SprungMesh::add_spring(double x, double stiffness, double length) {
  const SparseFunctional at = *other_->displacement_at(symmetric() ? std::min(x, length - x) : x);
  for (const auto& a : at.terms) {
    ground_force_[a.unknown] += stiffness * a.coefficient;
    ground_moment_[a.unknown] += stiffness * x * a.coefficient;
  }
  at.add_square(stiffness, springs_);
}

void SprungMesh::add_shear_forces(std::span<const double> unknowns,
                                  std::span<double> forces) const {
  other_->add_shear_forces(unknowns, forces);
  springs_.subtract_product(unknowns, forces);
}

double SprungMesh::shear_energy(std::span<const double> unknowns) const {
  return other_->shear_energy(unknowns) + 0.5 * springs_.quadratic_form(unknowns);
}

double SprungMesh::highest_frequency(double bending_stiffness) const {
  const double other = other_->highest_frequency(bending_stiffness);
  return std::sqrt(other * other + frequency_squared_);
}

}  // namespace subimpact
