#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "model/mesh/modes.h"
#include "numerics/dense.h"
#include "numerics/lanes.h"

namespace subimpact {

void normalise(NaturalModes& modes, const BandedMatrix& mass) {
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const double scale = 1.0 / std::sqrt(mass.quadratic_form(modes.shape(k)));
    for (double& entry : modes.shape(k)) entry *= scale;
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
  for (std::size_t k = 0; k < n; ++k) {
    double share = 0.0;
    for (std::size_t i = 0; i < n; ++i) share += momentum[i] * modes.shape(k)[i];
    for (std::size_t i = 0; i < n; ++i) modes.shape(k)[i] -= share / mass * translation[i];
  }
  const bool rotates = n > 1 && modes.frequencies[1] == 0.0;
  if (rotates &&
      mesh.mass().quadratic_form(modes.shape(0)) > mesh.mass().quadratic_form(modes.shape(1))) {
    std::ranges::copy(modes.shape(0), modes.shape(1).begin());
  }
  std::ranges::copy(translation, modes.shape(0).begin());
  normalise(modes, mesh.mass());
  // A matrix that is decomposed leaves in the rotation some 1e-9 of the lowest modes.
  if (rotates) make_orthogonal(modes, 1, mesh.mass());
}

// A mode counts as rigid below this share of the highest frequency, if it is also below that of the
// third lowest: a beam has at most two rigid modes, and of one that has none the lowest frequency,
// which on fine meshes is a small share of the highest, is a 25th of the third or more.
constexpr double rigid_share = 1e-7;
constexpr double rigid_share_of_third = 0.02;

double rigid_below(std::span<const double> frequencies) {
  std::vector<double> sorted(frequencies.begin(), frequencies.end());
  std::ranges::sort(sorted);
  const double third = sorted[std::min<std::size_t>(2, sorted.size() - 1)];
  return std::min(rigid_share * sorted.back(), rigid_share_of_third * third);
}

// Eigenvalues closer than this are a cluster, within which any shapes do.
constexpr double cluster_share = 1e-6;
// A correction leaves an error as large as its square.
constexpr double small_correction = 1e-5;
constexpr int most_corrections = 4;

// What write(shape, column) makes of every shape, from columns of `size` zeros.
template <class Write>
Eigen::MatrixXd of_every(const Eigen::MatrixXd& shapes, std::size_t size, Write write) {
  const auto n = static_cast<std::size_t>(shapes.rows());
  const auto rows = static_cast<Eigen::Index>(size);
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(rows, shapes.cols());
  for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
    write(std::span(shapes.col(k).data(), n), std::span(columns.col(k).data(), size));
  }
  return columns;
}

// B phi for every mode, times the root of each section's weight and stiffness: S = phi^T K phi is
// the product of this matrix with itself, and low modes keep their digits in spite of high ones,
// which K phi would take from them.
Eigen::MatrixXd scaled_curvatures(const BeamMesh& mesh, double bending_stiffness,
                                  const Eigen::MatrixXd& shapes) {
  return of_every(shapes, mesh.n_sections(), [&](auto shape, std::span<double> kappa) {
    mesh.curvatures(shape, kappa);
    for (std::size_t i = 0; i < kappa.size(); ++i) {
      kappa[i] *= std::sqrt(mesh.section_weights()[i] * bending_stiffness);
    }
  });
}

// X becomes X (I + E), where E removes to first order what keeps X^T Mass X from I and X^T K X from
// a diagonal matrix (Ogita and Aishima, Jpn. J. Ind. Appl. Math. 35, 2018, 1007-1035). Rounding in
// a decomposition mixes modes i and j by some 1e-16 of the highest eigenvalue over the difference
// of theirs, which grows as the fourth power of the number of elements. Returns the largest of E.
double correct_shapes(const BeamMesh& mesh, double bending_stiffness, Eigen::MatrixXd& shapes) {
  const Eigen::Index n = shapes.cols();
  const std::size_t size = mesh.n_unknowns();
  Eigen::MatrixXd energies = Eigen::MatrixXd::Zero(n, n);  // lower halves only
  energies.selfadjointView<Eigen::Lower>().rankUpdate(
      scaled_curvatures(mesh, bending_stiffness, shapes).transpose());
  if (mesh.is_sprung()) {  // forces are -K_s phi
    const auto forces = [&](auto phi, auto force) { mesh.add_shear_forces(phi, force); };
    energies.triangularView<Eigen::Lower>() -= shapes.transpose() * of_every(shapes, size, forces);
  }
  Eigen::MatrixXd products(n, n);
  const auto inertia = [&](auto phi, auto of_phi) { mesh.mass().multiply(phi, of_phi); };
  products.triangularView<Eigen::Lower>() = shapes.transpose() * of_every(shapes, size, inertia);
  const Eigen::VectorXd eigenvalues = energies.diagonal().cwiseQuotient(products.diagonal());
  const Eigen::VectorXd frequencies = eigenvalues.cwiseMax(0.0).cwiseSqrt();
  const double rigid = std::pow(rigid_below({frequencies.data(), static_cast<std::size_t>(n)}), 2);
  Eigen::MatrixXd correction(n, n);
  double largest = 0.0;
  for (Eigen::Index j = 0; j < n; ++j) {
    correction(j, j) = 0.5 * (1.0 - products(j, j));
    for (Eigen::Index i = j + 1; i < n; ++i) {
      const double difference = eigenvalues(j) - eigenvalues(i);
      const double larger = std::max(eigenvalues(i), eigenvalues(j));
      const bool one_cluster = larger <= rigid || std::abs(difference) <= cluster_share * larger;
      const double product = products(i, j);
      const double energy = energies(i, j);
      correction(i, j) =
          one_cluster ? -0.5 * product : (energy - eigenvalues(j) * product) / difference;
      correction(j, i) =
          one_cluster ? -0.5 * product : (eigenvalues(i) * product - energy) / difference;
      largest = std::max({largest, std::abs(correction(i, j)), std::abs(correction(j, i))});
    }
  }
  shapes += shapes * correction;
  return largest;
}

// K phi = omega^2 Mass phi. A diagonal mass makes it a standard problem, at some half the cost.
Eigen::MatrixXd shapes_of(Eigen::MatrixXd stiffness, const BandedMatrix& mass) {
  const Eigen::Index n = stiffness.rows();
  const auto entry = [&](Eigen::Index i, Eigen::Index j) {
    return mass(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  };
  if (mass.half_bandwidth() == 0) {
    Eigen::VectorXd scale(n);
    for (Eigen::Index i = 0; i < n; ++i) scale(i) = 1.0 / std::sqrt(entry(i, i));
    stiffness = scale.asDiagonal() * stiffness * scale.asDiagonal();
    return scale.asDiagonal() * eigen_pairs(stiffness).vectors;
  }
  return eigen_pairs(stiffness, Eigen::MatrixXd::NullaryExpr(n, n, entry)).vectors;
}

Eigen::MatrixXd decomposed_shapes(const BeamMesh& mesh, double bending_stiffness) {
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
    mesh.internal_forces(unit, kappa, force);
    for (Eigen::Index i = 0; i < n; ++i) stiffness(i, j) = -force[static_cast<std::size_t>(i)];
    unit[column] = 0.0;
  }
  return shapes_of(std::move(stiffness), mesh.mass());
}

}  // namespace

void make_orthogonal(NaturalModes& modes, std::size_t k, const BandedMatrix& mass) {
  const std::span<double> shape = modes.shape(k);
  std::vector<double> inertia(shape.size());
  mass.multiply(shape, inertia);
  for (std::size_t j = 0; j < modes.size(); ++j) {
    if (j == k) continue;
    const double share = dot(inertia.data(), modes.shape(j).data(), shape.size());
    for (std::size_t i = 0; i < shape.size(); ++i) shape[i] -= share * modes.shape(j)[i];
  }
  const double size = std::sqrt(mass.quadratic_form(shape));
  for (double& value : shape) value /= size;
}

NaturalModes dense_natural_modes(const BeamMesh& mesh, double bending_stiffness) {
  NaturalModes modes;
  modes.frequencies.resize(mesh.n_unknowns());
  {
    Eigen::MatrixXd shapes = decomposed_shapes(mesh, bending_stiffness);
    const int corrections = mesh.shears() && !mesh.is_sprung() ? 0 : most_corrections;
    for (int i = 0; i < corrections; ++i) {
      if (correct_shapes(mesh, bending_stiffness, shapes) < small_correction) break;
    }
    modes.shapes.assign(shapes.data(), shapes.data() + shapes.size());
  }
  complete(modes, mesh, bending_stiffness);
  return modes;
}

void complete(NaturalModes& modes, const BeamMesh& mesh, double bending_stiffness) {
  normalise(modes, mesh.mass());
  std::vector<double> kappa(mesh.n_sections());
  for (std::size_t k = 0; k < modes.size(); ++k) {
    mesh.curvatures(modes.shape(k), kappa);
    double twice_energy = 2.0 * mesh.shear_energy(modes.shape(k));
    for (std::size_t i = 0; i < kappa.size(); ++i) {
      twice_energy += mesh.section_weights()[i] * bending_stiffness * kappa[i] * kappa[i];
    }
    modes.frequencies[k] = std::sqrt(std::max(twice_energy, 0.0));  // rounding
  }
  const double rigid = rigid_below(modes.frequencies);
  for (double& frequency : modes.frequencies) {
    if (frequency <= rigid) frequency = 0.0;
  }
  free_of_translation(modes, mesh);
}

}  // namespace subimpact
