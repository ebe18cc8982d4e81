#include "subimpact/model/natural_modes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "subimpact/model/beam_mesh.h"

namespace subimpact {

void normalise(NaturalModes& modes, const BandedMatrix& mass) {
  const std::size_t n = modes.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::span<double> shape(modes.shapes.data() + k * n, n);
    const double scale = 1.0 / std::sqrt(mass.quadratic_form(shape));
    for (double& entry : shape) entry *= scale;
  }
}

namespace {

// The decomposition leaves in every mode a share of the rigid translation that rounding makes, some
// 1e-10 on fine meshes, and with it momentum. The first rigid mode becomes the translation itself,
// the second, if there is one, the rotation that is left of both.
void free_of_translation(NaturalModes& modes, const BeamMesh& mesh) {
  const std::span<const double> translation = mesh.translation();
  if (translation.empty() || modes.frequencies.front() != 0.0) return;
  const std::size_t n = modes.size();
  std::vector<double> momentum(n);  // of a velocity in each unknown
  mesh.mass().multiply(translation, momentum);
  const double mass = mesh.mass().quadratic_form(translation);
  const auto shape = [&](std::size_t k) { return std::span(modes.shapes.data() + k * n, n); };
  for (std::size_t k = 0; k < n; ++k) {
    double share = 0.0;
    for (std::size_t i = 0; i < n; ++i) share += momentum[i] * shape(k)[i];
    for (std::size_t i = 0; i < n; ++i) shape(k)[i] -= share / mass * translation[i];
  }
  const bool rotates = n > 1 && modes.frequencies[1] == 0.0;
  if (rotates && mesh.mass().quadratic_form(shape(0)) > mesh.mass().quadratic_form(shape(1))) {
    std::ranges::copy(shape(0), shape(1).begin());
  }
  std::ranges::copy(translation, shape(0).begin());
  normalise(modes, mesh.mass());
}

struct Decomposition {
  Eigen::VectorXd squared_frequencies;  // ascending
  Eigen::MatrixXd shapes;
};

template <class Solver>
void check(const Solver& solver) {
  if (solver.info() == Eigen::Success) return;
  throw std::runtime_error("natural modes: the eigenvalue decomposition did not converge");
}

// K phi = omega^2 Mass phi. A diagonal mass makes it a standard problem, at some half the cost.
Decomposition decompose(Eigen::MatrixXd stiffness, const BandedMatrix& mass) {
  const Eigen::Index n = stiffness.rows();
  const auto entry = [&](Eigen::Index i, Eigen::Index j) {
    return mass(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  };
  if (mass.half_bandwidth() == 0) {
    Eigen::VectorXd scale(n);
    for (Eigen::Index i = 0; i < n; ++i) scale(i) = 1.0 / std::sqrt(entry(i, i));
    stiffness = scale.asDiagonal() * stiffness * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness);
    check(solver);
    return {solver.eigenvalues(), scale.asDiagonal() * solver.eigenvectors()};
  }
  const Eigen::MatrixXd dense = Eigen::MatrixXd::NullaryExpr(n, n, entry);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, dense);
  check(solver);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace

NaturalModes dense_natural_modes(const BeamMesh& mesh, double bending_stiffness) {
  const auto n = static_cast<Eigen::Index>(mesh.n_unknowns());
  Eigen::MatrixXd stiffness(n, n);
  std::vector<double> unit(mesh.n_unknowns());
  std::vector<double> kappa(mesh.n_sections());
  std::vector<double> force(mesh.n_unknowns());
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto column = static_cast<std::size_t>(j);
    unit[column] = 1.0;
    mesh.curvatures(unit, kappa);
    for (double& k : kappa) k *= bending_stiffness;
    mesh.bending_forces(kappa, force);
    mesh.add_shear_forces(unit, force);
    for (Eigen::Index i = 0; i < n; ++i) stiffness(i, j) = -force[static_cast<std::size_t>(i)];
    unit[column] = 0.0;
  }
  const Decomposition found = decompose(std::move(stiffness), mesh.mass());
  NaturalModes modes;
  modes.frequencies.resize(mesh.n_unknowns());
  modes.shapes.assign(found.shapes.data(), found.shapes.data() + n * n);
  const double highest = std::sqrt(found.squared_frequencies(n - 1));
  for (std::size_t k = 0; k < modes.size(); ++k) {
    mesh.curvatures(modes.shape(k), kappa);
    double twice_energy = 2.0 * mesh.shear_energy(modes.shape(k));
    for (std::size_t i = 0; i < kappa.size(); ++i) {
      twice_energy += mesh.section_weights()[i] * bending_stiffness * kappa[i] * kappa[i];
    }
    const double frequency = std::sqrt(twice_energy);
    modes.frequencies[k] = frequency > 1e-7 * highest ? frequency : 0.0;
  }
  free_of_translation(modes, mesh);
  return modes;
}

}  // namespace subimpact
