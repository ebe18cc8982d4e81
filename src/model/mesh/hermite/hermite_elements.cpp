#include "model/mesh/hermite/hermite_elements.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "numerics/dense.h"

namespace subimpact {

using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

HermiteElement::HermiteElement(double a, double h)
    : length(a),
      slope_unit(h),
      mean(1.0 / (a * h)),
      of_displacements(6.0 / (a * a)),
      of_slopes(3.0 / (a * h)) {}

HermiteElement::Coefficients HermiteElement::curvature(double at) const {
  return {at * of_displacements, -mean + at * of_slopes, -at * of_displacements,
          mean + at * of_slopes};
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

double HermiteElement::highest_frequency_squared(double bending_stiffness,
                                                 const Matrix& mass) const {
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(4, 4);
  for (const double at : eta) {
    const Eigen::Vector4d row(curvature(at).data());
    stiffness += bending_stiffness * 0.5 * length * row * row.transpose();
  }
  return largest_eigenvalue(stiffness, Eigen::Map<const Matrix4>(mass[0].data()));
}

HermiteNodes::HermiteNodes(const Beam& beam, double position, std::size_t n_elements, bool is_half)
    : half(is_half), ends(beam.ends) {
  if (n_elements < fewest_elements) {
    throw std::invalid_argument("hermite mesh: at least 4 elements are needed");
  }
  if (half && (n_elements % 2 != 0 || position != 0.5 || ends[0] != ends[1])) {
    throw std::invalid_argument(
        "hermite mesh: a half model needs an even number of elements, struck at 0.5, and ends "
        "alike");
  }
  place(position * beam.length, half ? 0.0 : (1.0 - position) * beam.length,
        half ? n_elements / 2 : n_elements);
  number_unknowns();
  if (struck_node().displacement == none) {
    throw std::invalid_argument("hermite mesh: the strike is on a support");
  }
}

void HermiteNodes::place(double left, double right, std::size_t n_elements) {
  struck = n_elements;
  if (!half) {
    struck = static_cast<std::size_t>(
        std::lround(static_cast<double>(n_elements) * left / (left + right)));
    if (left > 0.0) struck = std::max<std::size_t>(struck, 1);
    if (right > 0.0) struck = std::min(struck, n_elements - 1);
  }
  lengths.assign(struck, left / static_cast<double>(struck));
  lengths.resize(n_elements, right / static_cast<double>(n_elements - struck));
}

void HermiteNodes::number_unknowns() {
  std::size_t next = 0;
  for (std::size_t i = 0; i <= n_elements(); ++i) {
    const bool mirror = half && i == n_elements();
    EndSupport support = EndSupport::free;
    if (i == 0) support = ends[0];
    if (i == n_elements() && !mirror) support = ends[1];
    Node& node = nodes.emplace_back(none, none);
    if (support == EndSupport::free) node.displacement = next++;
    if (support != EndSupport::clamped && !mirror) node.slope = next++;
  }
  n_unknowns = next;
}

std::array<std::size_t, 4> HermiteNodes::unknowns_of(std::size_t element) const {
  const Node& left = nodes[element];
  const Node& right = nodes[element + 1];
  return {left.displacement, left.slope, right.displacement, right.slope};
}

std::pair<std::size_t, double> HermiteNodes::element_at(double x) const {
  constexpr double at_node = 1e-9;  // distance in units of an element's length
  double left = 0.0;
  std::size_t e = 0;
  for (; e + 1 < n_elements() && x >= left + (1.0 - at_node) * lengths[e]; ++e) {
    left += lengths[e];
  }
  const double z = (x - left) / lengths[e];
  return {e, z < at_node ? 0.0 : z > 1.0 - at_node ? 1.0 : z};
}

}  // namespace subimpact
