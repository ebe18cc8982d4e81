#include "model/contact/contact_geometry.h"

#include <algorithm>
#include <utility>

#include "numerics/bracketed_root.h"

namespace subimpact {

double contact_compliance(double modulus_1, double poisson_1, double modulus_2, double poisson_2) {
  return (1.0 - poisson_1 * poisson_1) / modulus_1 + (1.0 - poisson_2 * poisson_2) / modulus_2;
}

GapRadii gap_radii(const Scene& scene) {
  const double nose = scene.striker.nose_radius.value_or(std::nan(""));
  const double own = scene.nose() == NoseShape::sphere ? nose : INFINITY;  // across the beam
  return {nose, scene.beam.is_round() ? 1.0 / (1.0 / own + 2.0 / scene.beam.height()) : own};
}

double hertz_stiffness(GapRadii radii, double compliance) {
  const double least = std::min(radii.along, radii.across);
  const double ratio = std::max(radii.along, radii.across) / least;
  const double of_circle = 4.0 / 3.0 * std::sqrt(least * std::sqrt(ratio)) / compliance;
  if (ratio < 1.0 + 1e-5) return of_circle;
  // The ellipse of contact, a > b: k^2 = 1 - b^2/a^2, K and E the complete elliptic integrals.
  const auto shape = [](double axes) {
    const double k = std::sqrt(1.0 - 1.0 / (axes * axes));
    const double K = std::comp_ellint_1(k), E = std::comp_ellint_2(k);
    return std::pair{(axes * axes * E - K), K - E};
  };
  const double axes = root_in(
      [&](double x) {
        const auto [major, minor] = shape(x);
        return major - ratio * minor;
      },
      1.0 + 1e-6, ratio);
  const auto [major, minor] = shape(axes);
  const double k2 = 1.0 - 1.0 / (axes * axes);
  // F_1^3 and F_2 of the source.
  const double of_size = 4.0 / (M_PI * k2) * std::pow(axes, -1.5) * std::sqrt(major * minor);
  const double of_approach =
      2.0 / M_PI / std::sqrt(axes) / std::cbrt(of_size) * std::comp_ellint_1(std::sqrt(k2));
  return of_circle * std::pow(of_approach, -1.5);
}

}  // namespace subimpact
