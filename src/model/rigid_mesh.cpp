#include "model/rigid_mesh.h"

#include <algorithm>
#include <array>

namespace subimpact {
namespace {

std::size_t degrees_of_freedom(double position) { return position == 0.5 ? 1 : 2; }

}  // namespace

RigidMesh::RigidMesh(const Beam& beam, double position)
    : BeamMesh(degrees_of_freedom(position), 0, false), length_(beam.length) {
  const double l = beam.length;
  mass_.at(0, 0) = beam.mass();
  struck_point_.terms = {{0, 1.0}};
  first_end_.terms = {{0, 1.0}};
  if (n_unknowns() == 2) {
    mass_.at(1, 1) = beam.mass() * l * l / 12.0 + beam.rotary_inertia() * l;
    struck_point_.terms.push_back({1, (position - 0.5) * l});
    first_end_.terms.push_back({1, -0.5 * l});
  }
  translation_.assign(n_unknowns(), 0.0);
  translation_[0] = 1.0;
  momentum_functional_.assign(n_unknowns(), 0.0);
  momentum_functional_[0] = beam.mass();
  beam_mass_ = beam.mass();
  weights_ = {l};
  add_stencil(0, std::array{0.0});
  positions_ = {position * l};
}

void RigidMesh::curvatures(std::span<const double>, std::span<double> kappa) const {
  std::fill(kappa.begin(), kappa.end(), 0.0);
}

void RigidMesh::bending_forces(std::span<const double>, std::span<double> forces) const {
  std::fill(forces.begin(), forces.end(), 0.0);
}

std::optional<SparseFunctional> RigidMesh::displacement_at(double x) const {
  SparseFunctional displacement{{{0, 1.0}}, {}};
  if (n_unknowns() == 2) displacement.terms.push_back({1, x - 0.5 * length_});
  return displacement;
}

std::optional<SparseFunctional> RigidMesh::rotation_at(double) const {
  if (n_unknowns() == 1) return SparseFunctional{};
  return SparseFunctional{{{1, 1.0}}, {}};
}

double RigidMesh::highest_frequency(double) const { return 0.0; }

}  // namespace subimpact
