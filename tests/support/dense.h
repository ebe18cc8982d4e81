#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "banded_examples.h"
#include "numerics/dense.h"
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
  return eigen_pairs(stiffness_matrix(mesh, bending_stiffness), dense(mesh.mass())).values;
}

inline std::vector<double> dense_frequencies(const BeamMesh& mesh, double bending_stiffness) {
  const Eigen::VectorXd roots =
      squared_frequencies(mesh, bending_stiffness).cwiseMax(0.0).cwiseSqrt();
  return {roots.begin(), roots.end()};
}

/// The highest natural frequency.
inline double highest_of(const BeamMesh& mesh, double bending_stiffness) {
  return std::sqrt(
      largest_eigenvalue(stiffness_matrix(mesh, bending_stiffness), dense(mesh.mass())));
}

/// The x of least norm with K x = load, K symmetric and positive semidefinite; refined.
inline Eigen::VectorXd solution(const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& load) {
  const auto [values, vectors] = eigen_pairs(stiffness);
  const double zero = 1e-13 * values(values.size() - 1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(load.size());
  const auto extended = [](const auto& a) { return a.template cast<long double>(); };
  for (int i = 0; i < 3; ++i) {
    const auto rest = (extended(load) - extended(stiffness) * extended(x)).eval();
    Eigen::VectorXd parts = vectors.transpose() * rest.template cast<double>();
    for (Eigen::Index k = 0; k < parts.size(); ++k) {
      parts(k) = values(k) > zero ? parts(k) / values(k) : 0.0;
    }
    x += vectors * parts;
  }
  return x;
}

}  // namespace subimpact
