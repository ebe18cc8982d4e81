#include "model/contact/power_contact.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "model/contact/contact_laws.h"

namespace subimpact {

PowerContact::PowerContact(double stiffness, double exponent, double yield_indentation,
                           std::string name, Limit limit)
    : stiffness_(stiffness),
      exponent_(exponent),
      yield_indentation_(yield_indentation),
      name_(std::move(name)),
      limit_(limit) {
  if (!(stiffness > 0.0) || !std::isfinite(stiffness) || !(exponent >= 1.0) ||
      !(yield_indentation > 0.0)) {
    throw std::invalid_argument(
        "contact law: stiffness and yield indentation must be positive, the exponent at least 1");
  }
}

// Powers are odd functions, so that a branch goes on smoothly where a trial step leaves its range.
double PowerContact::power(double x) const {
  if (exponent_ == 1.5) return x * std::sqrt(std::abs(x));
  if (exponent_ == 1.0) return x;
  return std::copysign(std::pow(std::abs(x), exponent_), x);
}

double PowerContact::power_slope(double x) const {
  if (exponent_ == 1.5) return 1.5 * std::sqrt(std::abs(x));
  return exponent_ * std::pow(std::abs(x), exponent_ - 1.0);
}

double PowerContact::power_integral(double x) const {
  return std::abs(x) * std::abs(power(x)) / (exponent_ + 1.0);
}

double PowerContact::force(ContactHistory history, double indentation) const {
  return stiffness_ * (power(indentation) - power(residual_indentation(history)));
}

double PowerContact::slope(ContactHistory /*history*/, double indentation) const {
  return stiffness_ * power_slope(indentation);
}

double PowerContact::plastic_force(double indentation) const {
  return stiffness_ * (power(indentation) - power(indentation - yield_indentation_));
}

double PowerContact::plastic_slope(double indentation) const {
  return stiffness_ * (power_slope(indentation) - power_slope(indentation - yield_indentation_));
}

double PowerContact::recoverable_energy(ContactHistory history, double indentation) const {
  const ContactHistory now = commit(history, indentation);
  const double residual = residual_indentation(now);
  if (indentation <= residual) return 0.0;
  return stiffness_ * (power_integral(indentation) - power_integral(residual) -
                       power(residual) * (indentation - residual));
}

double PowerContact::dissipated_energy(ContactHistory history) const {
  const double residual = residual_indentation(history);
  if (residual == 0.0) return 0.0;
  return stiffness_ * power(residual) * yield_indentation_;
}

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
