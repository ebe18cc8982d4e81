#include "model/hermite_element.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>

#include "numerics/bracketed_root.h"
#include "numerics/gauss.h"

namespace subimpact {
namespace {

using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

// In eta = 2 s - 1, from the points up to the middle, which have the most digits.
template <std::size_t n>
ElementRule gauss_in_eta() {
  ElementRule rule;
  for (std::size_t i = 0; i < n; ++i) {
    rule.points.push_back(2 * i < n ? 2.0 * gauss<n>.points[i] - 1.0
                                    : 1.0 - 2.0 * gauss<n>.points[n - 1 - i]);
    rule.weights.push_back(gauss<n>.weights[i]);
    rule.of_curvature.push_back({1.0, rule.points.back()});
  }
  return rule;
}

// Two points and weights at distances x (shares of the element) from a hinge that, with the hinge's
// own weight at 0, integrate 1, x and x^2.
struct Pair {
  double near, far, near_weight, far_weight;
};

Pair pair_with(double near) {
  const double weight = 1.0 - hinge_share;
  const double far = (1.0 / 3.0 - 0.5 * near) / (0.5 - weight * near);
  const double near_weight = (weight * far - 0.5) / (far - near);
  return {near, far, near_weight, weight - near_weight};
}

// The pair that integrates x^(-1/2), too.
Pair pair_beside_hinge() {
  const double too_near = 1e-3;  // too much of the peak
  const double too_far = 0.2;    // too little, as at Gauss' 0.211
  const auto excess = [](double near) {
    const Pair pair = pair_with(near);
    return pair.near_weight / std::sqrt(pair.near) + pair.far_weight / std::sqrt(pair.far) - 2.0;
  };
  return pair_with(root_in(excess, too_near, too_far));
}

}  // namespace

ElementRule gauss_rule(std::size_t n) {
  switch (n) {
    case 2:
      return gauss_in_eta<2>();
    case 3:
      return gauss_in_eta<3>();
    case 4:
      return gauss_in_eta<4>();
    default:
      throw std::invalid_argument("hermite mesh: 2, 3 or 4 sections per element");
  }
}

ElementRule rule_beside_hinges(bool at_start, bool at_end) {
  ElementRule rule;
  if (at_start && at_end) {
    const double weight = 0.5 - hinge_share;
    const double eta = std::sqrt((1.0 / 6.0 - hinge_share) / weight);
    rule = {{-eta, eta}, {weight, weight}, {}};
  } else {
    static const Pair pair = pair_beside_hinge();
    const double near = 1.0 - 2.0 * pair.near;
    const double far = 1.0 - 2.0 * pair.far;
    if (at_start) {
      rule = {{-near, -far}, {pair.near_weight, pair.far_weight}, {}};
    } else {
      rule = {{far, near}, {pair.far_weight, pair.near_weight}, {}};
    }
  }
  // mean = sum w kappa and half = 3 sum w eta kappa is the condition on the moments; solved for the
  // two kappa.
  const auto& eta = rule.points;
  const auto& w = rule.weights;
  const double apart = eta[1] - eta[0];
  rule.of_curvature = {{eta[1] / (w[0] * apart), -1.0 / (3.0 * w[0] * apart)},
                       {-eta[0] / (w[1] * apart), 1.0 / (3.0 * w[1] * apart)}};
  return rule;
}

HermiteElement::HermiteElement(double a, double h)
    : length(a),
      slope_unit(h),
      mean(1.0 / (a * h)),
      of_displacements(6.0 / (a * a)),
      of_slopes(3.0 / (a * h)) {}

HermiteElement::Coefficients HermiteElement::curvature(
    const std::array<double, 2>& of_curvature) const {
  const auto [of_mean, of_half] = of_curvature;
  return {of_half * of_displacements, -of_mean * mean + of_half * of_slopes,
          -of_half * of_displacements, of_mean * mean + of_half * of_slopes};
}

HermiteElement::Coefficients HermiteElement::displacement(double z) const {
  const double s = length / slope_unit;
  return {(1.0 - z) * (1.0 - z) * (1.0 + 2.0 * z), s * z * (1.0 - z) * (1.0 - z),
          z * z * (3.0 - 2.0 * z), -s * z * z * (1.0 - z)};
}

HermiteElement::Coefficients HermiteElement::slope(double z) const {
  const double of_difference = 6.0 * z * (1.0 - z) / length;
  return {-of_difference, (1.0 - z) * (1.0 - 3.0 * z) / slope_unit, of_difference,
          z * (3.0 * z - 2.0) / slope_unit};
}

HermiteElement::Matrix HermiteElement::mass(double mass_per_length, double rotary_inertia) const {
  const double s = length / slope_unit;  // unknown h t contributes t = (h t)/h
  Eigen::Matrix4d translation;
  translation << 156.0, 22.0, 54.0, -13.0,  //
      22.0, 4.0, 13.0, -3.0,                //
      54.0, 13.0, 156.0, -22.0,             //
      -13.0, -3.0, -22.0, 4.0;
  Eigen::Matrix4d rotation;
  rotation << 36.0, 3.0, -36.0, 3.0,  //
      3.0, 4.0, -3.0, -1.0,           //
      -36.0, -3.0, 36.0, -3.0,        //
      3.0, -1.0, -3.0, 4.0;
  const Eigen::Vector4d unit(1.0, s, 1.0, s);
  Matrix result;
  Eigen::Map<Matrix4>(result[0].data()) = unit.asDiagonal() *
                                          (mass_per_length * length / 420.0 * translation +
                                           rotary_inertia / (30.0 * length) * rotation) *
                                          unit.asDiagonal();
  return result;
}

HermiteElement::Coefficients HermiteElement::momentum(double mass_per_length) const {
  const double share = mass_per_length * length;
  const double lever = length / (12.0 * slope_unit);
  return {0.5 * share, lever * share, 0.5 * share, -lever * share};
}

HermiteElement::Coefficients HermiteElement::moment(double mass_per_length, double rotary_inertia,
                                                    double left) const {
  const double s = length / slope_unit;
  const double share = mass_per_length * length;
  return {share * (left / 2.0 + 3.0 * length / 20.0) - rotary_inertia,
          share * s * (left / 12.0 + length / 30.0),
          share * (left / 2.0 + 7.0 * length / 20.0) + rotary_inertia,
          -share * s * (left / 12.0 + length / 20.0)};
}

double HermiteElement::highest_frequency_squared(const ElementRule& rule,
                                                 std::array<double, 2> springs,
                                                 double bending_stiffness,
                                                 const Matrix& mass) const {
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(4, 4);
  stiffness(1, 1) = springs[0];
  stiffness(3, 3) = springs[1];
  for (std::size_t g = 0; g < rule.size(); ++g) {
    const Eigen::Vector4d row(curvature(rule.of_curvature[g]).data());
    stiffness += bending_stiffness * rule.weights[g] * length * row * row.transpose();
  }
  const Eigen::MatrixXd inertia = Eigen::Map<const Matrix4>(mass[0].data());
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, inertia,
                                                                         Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(3);
}

}  // namespace subimpact
