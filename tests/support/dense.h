#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <span>
#include <vector>

#include "banded_examples.h"
#include "subimpact/model/mesh/beam_mesh.h"

namespace subimpact {

inline std::span<const double> entries(const Eigen::VectorXd& x) {
  return {x.data(), static_cast<std::size_t>(x.size())};
}
inline std::span<double> entries(Eigen::VectorXd& x) {
  return {x.data(), static_cast<std::size_t>(x.size())};
}

inline std::vector<double> curvatures_of(const BeamMesh& mesh, std::span<const double> unknowns) {
  std::vector<double> kappa(mesh.n_sections());
  mesh.curvatures(unknowns, kappa);
  return kappa;
}

inline std::vector<double> bending_forces_of(const BeamMesh& mesh,
                                             std::span<const double> moments) {
  std::vector<double> forces(mesh.n_unknowns());
  mesh.bending_forces(moments, forces);
  return forces;
}

inline std::vector<double> times(const BandedMatrix& matrix, std::span<const double> x) {
  std::vector<double> product(x.size());
  matrix.multiply(x, product);
  return product;
}

/// The stiffness matrix of an elastic beam on a mesh, column by column out of curvatures, forces
/// and shear forces.
inline Eigen::MatrixXd stiffness_matrix(const BeamMesh& mesh, double bending_stiffness) {
  const Eigen::Index n = index(mesh.n_unknowns());
  Eigen::MatrixXd stiffness(n, n);
  std::vector<double> kappa(mesh.n_sections());
  Eigen::VectorXd forces(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(n, j);
    mesh.curvatures(entries(unit), kappa);
    for (double& value : kappa) value *= bending_stiffness;
    mesh.internal_forces(entries(unit), kappa, entries(forces));
    stiffness.col(j) = -forces;
  }
  return stiffness;
}

/// Squared natural frequencies of the elastic beam on a mesh, ascending, rigid modes included.
inline Eigen::VectorXd squared_frequencies(const BeamMesh& mesh, double bending_stiffness) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      stiffness_matrix(mesh, bending_stiffness), dense(mesh.mass()), Eigen::EigenvaluesOnly);
  return solver.eigenvalues();
}

inline std::vector<double> dense_frequencies(const BeamMesh& mesh, double bending_stiffness) {
  const Eigen::VectorXd roots =
      squared_frequencies(mesh, bending_stiffness).cwiseMax(0.0).cwiseSqrt();
  return {roots.begin(), roots.end()};
}

/// The highest natural frequency.
inline double highest_of(const BeamMesh& mesh, double bending_stiffness) {
  return std::sqrt(squared_frequencies(mesh, bending_stiffness).tail<1>()(0));
}

}  // namespace subimpact
