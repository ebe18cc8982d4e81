#include "model/flexural_frequencies.h"

#include <Eigen/Dense>
#include <cmath>

#include "numerics/bracketed_root.h"

namespace subimpact {
namespace {

// The determinant of the end conditions, continuous in beta; rows are scaled to a size near one.
double end_determinant(double beta, double slenderness, const std::array<EndSupport, 2>& ends) {
  const double b4 = std::pow(beta, 4);
  const double inertia = b4 * slenderness * slenderness;  // B r^2 = a^2 - b^2
  const double a = std::sqrt(0.5 * (inertia + std::sqrt(inertia * inertia + 4.0 * b4)));
  const double b = beta * beta / a;
  Eigen::Matrix4d conditions;
  for (int side = 0; side < 2; ++side) {
    const double c = std::cos(side * a);
    const double s = std::sin(side * a);
    const double near = std::exp(-b * side);       // of exp(-b xi)
    const double far = std::exp(-b * (1 - side));  // of exp(-b (1 - xi))
    Eigen::Matrix4d values;  // phi, phi', phi'' and phi''' + B r^2 phi' of the four functions
    values.row(0) << c, s, near, far;
    values.row(1) << -a * s, a * c, -b * near, b * far;
    values.row(2) << -a * a * c, -a * a * s, b * b * near, b * b * far;
    // phi''' + (a^2 - b^2) phi'
    values.row(3) << a * b * b * s, -a * b * b * c, -a * a * b * near, a * a * b * far;
    const EndSupport end = ends[static_cast<std::size_t>(side)];
    const int first = end == EndSupport::free ? 2 : 0;
    const int second = end == EndSupport::free ? 3 : end == EndSupport::pinned ? 2 : 1;
    conditions.row(2 * side) = values.row(first) / std::pow(beta, first);
    conditions.row(2 * side + 1) = values.row(second) / std::pow(beta, second);
  }
  return conditions.determinant();
}

}  // namespace

std::vector<double> flexural_wave_numbers(double slenderness, const std::array<EndSupport, 2>& ends,
                                          std::size_t n) {
  const auto f = [&](double beta) { return end_determinant(beta, slenderness, ends); };
  std::vector<double> roots;
  double low = 1.0;  // well below the first root of any ends, well above the rigid modes
  double at_low = f(low);
  while (roots.size() < n) {
    const double high = low + 0.05;
    const double at_high = f(high);
    if (at_low * at_high <= 0.0) roots.push_back(root_in(f, low, high));
    low = high;
    at_low = at_high;
  }
  return roots;
}

std::vector<double> flexural_frequencies(const Beam& beam, std::size_t n) {
  double slenderness =
      beam.theory == BeamTheory::euler_bernoulli ? 0.0 : beam.radius_of_gyration() / beam.length;
  if (beam.shears()) {
    slenderness *= std::sqrt(1.0 + beam.youngs_modulus * beam.area() / beam.shear_stiffness());
  }
  const double unit =
      std::sqrt(beam.bending_stiffness() / beam.mass_per_length()) / (beam.length * beam.length);
  std::vector<double> frequencies;
  for (const double beta : flexural_wave_numbers(slenderness, beam.ends, n)) {
    frequencies.push_back(unit * beta * beta);
  }
  return frequencies;
}

}  // namespace subimpact
