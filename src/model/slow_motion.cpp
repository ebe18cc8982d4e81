#include "model/slow_motion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/lanes.h"

namespace subimpact {
namespace {

// s, in units of the first frequency squared.
constexpr double shift_share = 0.1;
constexpr double rigid_share = 0.02;  // of s: below this omega^2 is that of a rigid mode
// Vectors beyond the modes wanted, and iterations: the last mode is then right to 1e-5.
constexpr std::size_t n_spare = 4;
constexpr int n_iterations = 12;

using Vector = std::vector<double>;
using Matrix = Eigen::MatrixXd;

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

std::span<double> column(Matrix& matrix, std::size_t k) {
  return {matrix.col(index(k)).data(), static_cast<std::size_t>(matrix.rows())};
}

void add(Vector& sum, double factor, std::span<const double> other) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factor * other[i];
}

SlowMotion from_all_modes(const BeamMesh& mesh, double stiffness, std::size_t n_modes) {
  const NaturalModes modes = mesh.natural_modes(stiffness);
  SlowMotion found{{}, {}, Vector(mesh.n_unknowns(), 0.0)};
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const std::span<const double> phi = modes.shape(k);
    const double omega = modes.frequencies[k];
    if (omega > 0.0) add(found.response, mesh.struck_point()(phi) / (omega * omega), phi);
    if (k >= n_modes) continue;
    found.frequencies.push_back(omega);
    found.shapes.emplace_back(phi.begin(), phi.end());
  }
  return found;
}

class SlowMotionByBands {
 public:
  SlowMotionByBands(const BeamMesh& mesh, double bending_stiffness, double first_period)
      : mesh_(mesh),
        n_(mesh.n_unknowns()),
        shift_(shift_share * std::pow(2.0 * std::numbers::pi / first_period, 2)),
        stiffness_(n_, std::max(mesh.stiffness_bandwidth(), mesh.mass().half_bandwidth())) {
    mesh.add_stiffness(Vector(mesh.n_sections(), bending_stiffness), stiffness_);
    BandedMatrix shifted = stiffness_;
    for (std::size_t j = 0; j < n_; ++j) {
      const std::size_t last = std::min(j + mesh.mass().half_bandwidth(), n_ - 1);
      for (std::size_t i = j; i <= last; ++i) shifted.at(i, j) += shift_ * mesh.mass().at(i, j);
    }
    factor_ = shifted.cholesky_factor();
  }

  std::optional<SlowMotion> find(std::size_t n_modes) const {
    if (!factor_) return std::nullopt;
    SlowMotion found;
    find_modes(std::min(n_modes, n_), found);
    find_response(found);
    return found;
  }

 private:
  void find_modes(std::size_t n_modes, SlowMotion& found) const {
    const std::size_t m = std::min(n_modes + n_spare, n_);
    Matrix x(index(n_), index(m)), inertia(index(n_), index(m));
    for (std::size_t k = 0; k < m; ++k) {  // any vectors that are not alike
      for (std::size_t i = 0; i < n_; ++i) {
        column(x, k)[i] = std::cos(static_cast<double>((i + 1) * (i + k + 1)));
      }
    }
    Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> ritz;
    for (int iteration = 0; iteration < n_iterations; ++iteration) {
      for (std::size_t k = 0; k < m; ++k) mesh_.mass().multiply(column(x, k), column(inertia, k));
      x = inertia;
      for (std::size_t k = 0; k < m; ++k) factor_->solve_as_factor(column(x, k));
      const Matrix stiffness = x.transpose() * inertia;  // X^T (K + s Mass) X
      for (std::size_t k = 0; k < m; ++k) mesh_.mass().multiply(column(x, k), column(inertia, k));
      ritz.compute(stiffness, x.transpose() * inertia);
      x *= ritz.eigenvectors();
    }
    for (std::size_t k = 0; k < n_modes; ++k) {
      const double squared = ritz.eigenvalues()[index(k)] - shift_;
      found.frequencies.push_back(squared > rigid_share * shift_ ? std::sqrt(squared) : 0.0);
      const std::span<double> phi = column(x, k);
      found.shapes.emplace_back(phi.begin(), phi.end());
    }
  }

  // Each iteration takes nine tenths of the error off, or more.
  void find_response(SlowMotion& found) const {
    Vector load(n_, 0.0), rest(n_);
    mesh_.struck_point().add_to(load, 1.0);
    balance(found, load);
    found.response.assign(n_, 0.0);
    for (int iteration = 0; iteration < n_iterations; ++iteration) {
      stiffness_.multiply(found.response, rest);
      for (std::size_t i = 0; i < n_; ++i) rest[i] = load[i] - rest[i];
      balance(found, rest);
      factor_->solve_as_factor(rest);
      add(found.response, 1.0, rest);
    }
  }

  // Takes from forces what moves the beam rigidly.
  void balance(const SlowMotion& motion, Vector& forces) const {
    Vector inertia(n_);
    for (std::size_t k = 0; k < motion.size() && motion.frequencies[k] == 0.0; ++k) {
      const Vector& phi = motion.shapes[k];
      mesh_.mass().multiply(phi, inertia);
      add(forces, -dot(phi.data(), forces.data(), n_), inertia);
    }
  }

  const BeamMesh& mesh_;
  std::size_t n_;
  double shift_;  // s, 1/s2
  BandedMatrix stiffness_;
  std::optional<BandedMatrix> factor_;  // of K + s Mass
};

}  // namespace

std::optional<SlowMotion> slow_motion(const BeamMesh& mesh, double bending_stiffness,
                                      double first_period, std::size_t n_modes) {
  if (!mesh.modal_stiffness().empty() || mesh.n_sections() == 0) {
    return from_all_modes(mesh, bending_stiffness, n_modes);
  }
  return SlowMotionByBands(mesh, bending_stiffness, first_period).find(n_modes);
}

}  // namespace subimpact
