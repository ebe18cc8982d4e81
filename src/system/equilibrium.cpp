#include "system/equilibrium.h"

#include <algorithm>

namespace subimpact {

// What K loses to rounding as a matrix is regained from the forces of the sections.
constexpr int n_refinements = 3;

std::optional<std::vector<double>> equilibrium(const StruckBeam& beam) {
  const BeamMesh& mesh = beam.mesh();
  const std::size_t n = mesh.n_unknowns();
  const double start = beam.loads().start();
  std::vector<double> q(n, 0.0), rest(n), kappa(mesh.n_sections());
  if (const auto modal = beam.modal_stiffness(); !modal.empty()) {
    if (std::ranges::count(modal, 0.0) > 0) return std::nullopt;
    beam.loads().add_to(q, start);
    for (std::size_t k = 0; k < n; ++k) q[k] /= modal[k];
    return q;
  }
  const double stiffness = beam.sections().stiffness();
  BandedMatrix matrix(n, mesh.stiffness_bandwidth());
  mesh.add_stiffness(std::vector<double>(mesh.n_sections(), stiffness), matrix);
  const auto factor = matrix.cholesky_factor();
  if (!factor) return std::nullopt;
  for (int i = 0; i <= n_refinements; ++i) {
    mesh.curvatures(q, kappa);
    for (double& k : kappa) k *= stiffness;
    mesh.bending_forces(kappa, rest);
    mesh.add_shear_forces(q, rest);
    beam.loads().add_to(rest, start);
    factor->solve_as_factor(rest);
    for (std::size_t k = 0; k < n; ++k) q[k] += rest[k];
  }
  return q;
}

}  // namespace subimpact
