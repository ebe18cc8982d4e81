#include "model/hermite_element.h"

#include <Eigen/Eigenvalues>

namespace subimpact {

using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

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
