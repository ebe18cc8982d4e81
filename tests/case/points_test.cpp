// A point of a struck beam against modal sums.

#include <Eigen/Dense>

#include "linear_case.h"

namespace subimpact {
namespace {

// Striker, linear spring and modes of a pinned beam, sin(n pi x/l), as one eigenproblem; valid up
// to the end of the first contact. The first modes move, the others follow the force as at rest:
// they are a spring in series with that of the contact.
class ModalSum {
  // Rounding of squared frequencies, relative to the largest, must not reach the smallest.
  using Real = long double;
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

 public:
  ModalSum(const Scene& scene, Eigen::Index n_modes)
      : n_(n_modes), scene_(scene), length_(scene.beam.length) {
    const Beam& beam = scene.beam;
    Vector root_mass(n_ + 1);
    Matrix stiffness = Matrix::Zero(n_ + 1, n_ + 1);
    indentation_.resize(n_ + 1);
    for (Eigen::Index k = 0; k < n_; ++k) {
      const Real b = wave(k);
      const Real mass = beam.mass_per_length() + beam.rotary_inertia() * b * b;
      root_mass(k) = std::sqrt(mass * length_ / 2);
      stiffness(k, k) = modal_stiffness(k);
      indentation_(k) = -std::sin(b * scene.striker.position * length_);
    }
    root_mass(n_) = std::sqrt(scene.striker.mass);
    indentation_(n_) = 1.0;
    spring_ = 1 / (1 / Real(*scene.contact.stiffness) +
                   compliance_of_rest(scene.striker.position * length_));
    stiffness += spring_ * indentation_ * indentation_.transpose();
    const Vector inverse = root_mass.cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(inverse.asDiagonal() * stiffness *
                                                       inverse.asDiagonal());
    frequencies_ = solver.eigenvalues().cwiseSqrt();
    shapes_ = inverse.asDiagonal() * solver.eigenvectors();
    rates_ = solver.eigenvectors().row(n_).transpose() * root_mass(n_) * scene.striker.velocity;
  }
  double displacement(double x, double t) const {
    const Vector amplitudes =
        rates_.array() * (frequencies_.array() * Real(t)).sin() / frequencies_.array();
    const Vector unknowns = shapes_ * amplitudes;
    Real sum = spring_ * indentation_.dot(unknowns) * compliance_of_rest(x);
    for (Eigen::Index k = 0; k < n_; ++k) sum += std::sin(wave(k) * x) * unknowns(k);
    return static_cast<double>(sum);
  }

 private:
  Real wave(Eigen::Index k) const {
    return static_cast<Real>(k + 1) * std::numbers::pi_v<Real> / length_;
  }
  Real modal_stiffness(Eigen::Index k) const {
    return scene_.beam.bending_stiffness() * std::pow(wave(k), 4) * length_ / 2;
  }
  // Displacement at x by a force of 1 N at the strike, of the modes beyond the first n.
  Real compliance_of_rest(Real x) const {
    const Real struck_at = scene_.striker.position * length_;
    Real sum = 0.0;
    for (Eigen::Index k = n_; k < 20 * n_; ++k) {
      sum += std::sin(wave(k) * x) * std::sin(wave(k) * struck_at) / modal_stiffness(k);
    }
    return sum;
  }

  Eigen::Index n_;
  Scene scene_;
  Real length_, spring_;
  Vector indentation_, frequencies_, rates_;
  Matrix shapes_;
};

TEST(APoint, MovesAsAModalSumOfAPinnedBeamStruckAtAThird) {
  Case input = linear_case(MeshKind::hermite, 900, third, pinned);
  input.scene.contact.stiffness = 1e5;
  input.solver.method = Method::exponential;
  input.solver.rtol = 1e-12;
  input.output.interval = 2e-5;
  input.output.points = {0.5, 0.1};
  const Result result = completed(input);
  const double end = result.end_of(result.sub_impacts.front());
  ASSERT_GT(end, 1e-4);
  const ModalSum sum(input.scene, 240);
  double largest = 0.0, error = 0.0;
  for (const PointRow& row : result.point_history) {
    if (row.time > end) break;
    const double expected = sum.displacement(row.position, row.time);
    largest = std::max(largest, std::abs(expected));
    error = std::max(error, std::abs(row.displacement - expected));
  }
  EXPECT_LT(error, 1e-8 * largest);
}

}  // namespace
}  // namespace subimpact
