#include "model/contact/sphere_contact.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model/contact/contact_geometry.h"

namespace subimpact {

SphereContact::SphereContact(double radius, double modulus, double yield_pressure)
    : modulus_(modulus), pressure_(yield_pressure) {
  for (const double x : {radius, modulus, yield_pressure}) {
    if (!(x > 0.0) || !std::isfinite(x)) {
      throw std::invalid_argument("contact law: radius, modulus and pressure must be positive");
    }
  }
  const double strain = 0.5 * M_PI * yield_pressure / modulus;  // a/R
  yield_indentation_ = strain * strain * radius;
  yield_force_ = hertz_stiffness({radius, radius}, 1.0 / modulus) * yield_indentation_ *
                 std::sqrt(yield_indentation_);
  plastic_stiffness_ = M_PI * yield_pressure * radius;
}

ContactScales SphereContact::scales() const {
  return {yield_force_ / (yield_indentation_ * std::sqrt(yield_indentation_)), 1.5};
}

SphereContact::Unloading SphereContact::unloading(ContactHistory history) const {
  if (history.max_indentation <= yield_indentation_) return {yield_force_, yield_indentation_, 0.0};
  const double force = plastic_force(history.max_indentation);
  const double a = std::sqrt((2.0 * force + yield_force_) / (2.0 * M_PI * pressure_));
  const double length = 0.75 * force / (modulus_ * a);
  return {force, length, std::max(history.max_indentation - length, 0.0)};
}

double SphereContact::residual_indentation(ContactHistory history) const {
  return unloading(history).residual;
}

double SphereContact::yield_threshold(ContactHistory history) const {
  return std::max(history.max_indentation, yield_indentation_);
}

double SphereContact::force(ContactHistory history, double indentation) const {
  const auto [force, length, residual] = unloading(history);
  const double part = (indentation - residual) / length;
  return force * part * std::sqrt(std::abs(part));
}

double SphereContact::slope(ContactHistory history, double indentation) const {
  const auto [force, length, residual] = unloading(history);
  return 1.5 * force / length * std::sqrt(std::abs(indentation - residual) / length);
}

double SphereContact::plastic_force(double indentation) const {
  return yield_force_ + plastic_stiffness_ * (indentation - yield_indentation_);
}

}  // namespace subimpact
