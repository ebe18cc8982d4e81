#include "model/contact_law.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace subimpact {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();  // as a yield indentation

}  // namespace

double hertz_stiffness(double radius, double modulus_1, double poisson_1, double modulus_2,
                       double poisson_2) {
  const double compliance = (1.0 - poisson_1 * poisson_1) / modulus_1 +
                            (1.0 - poisson_2 * poisson_2) / modulus_2;  // 1/E*
  return 4.0 / 3.0 * std::sqrt(radius) / compliance;
}

ContactLaw::ContactLaw(double stiffness, double exponent, double yield_indentation)
    : stiffness_(stiffness), exponent_(exponent), yield_indentation_(yield_indentation) {
  if (!(stiffness > 0.0) || !std::isfinite(stiffness) || !(exponent >= 1.0) ||
      !(yield_indentation > 0.0)) {
    throw std::invalid_argument(
        "contact law: stiffness and yield indentation must be positive, the exponent at least 1");
  }
}

ContactLaw ContactLaw::of(const Scene& scene) {
  const Beam& beam = scene.beam;
  const Contact& contact = scene.contact;
  const auto need = [](const std::optional<double>& constant) {
    if (!constant) throw std::invalid_argument("contact law: a constant that it needs is missing");
    return *constant;
  };
  switch (contact.kind) {
    case ContactKind::foundation:
      return ContactLaw(4.0 * std::sqrt(2.0 * need(scene.striker.nose_radius)) *
                            beam.youngs_modulus * beam.width / (3.0 * beam.thickness),
                        1.5, beam.yield_stress * beam.thickness / beam.youngs_modulus);
    case ContactKind::hertz:
      if (contact.stiffness) return ContactLaw(*contact.stiffness, 1.5, never);
      return ContactLaw(
          hertz_stiffness(need(scene.striker.nose_radius), need(contact.striker_modulus),
                          need(contact.striker_poisson), beam.youngs_modulus,
                          need(contact.beam_poisson)),
          1.5, never);
    case ContactKind::linear:
      return ContactLaw(need(contact.stiffness), 1.0, never);
  }
  throw std::invalid_argument("contact law: unknown kind");
}

// Powers are odd functions, so that a branch goes on smoothly where a trial step leaves its range.
double ContactLaw::power(double x) const {
  if (exponent_ == 1.5) return x * std::sqrt(std::abs(x));
  if (exponent_ == 1.0) return x;
  return std::copysign(std::pow(std::abs(x), exponent_), x);
}

double ContactLaw::power_slope(double x) const {
  if (exponent_ == 1.5) return 1.5 * std::sqrt(std::abs(x));
  return exponent_ * std::pow(std::abs(x), exponent_ - 1.0);
}

double ContactLaw::power_integral(double x) const {
  return std::abs(x) * std::abs(power(x)) / (exponent_ + 1.0);
}

ContactBranch ContactLaw::branch(ContactHistory history, double indentation) const {
  if (indentation <= residual_indentation(history)) return ContactBranch::separated;
  if (indentation <= yield_threshold(history)) return ContactBranch::elastic;
  return ContactBranch::plastic;
}

double ContactLaw::branch_force(ContactBranch branch, ContactHistory history,
                                double indentation) const {
  switch (branch) {
    case ContactBranch::separated:
      return 0.0;
    case ContactBranch::elastic:
      return stiffness_ * (power(indentation) - power(residual_indentation(history)));
    case ContactBranch::plastic:
      return stiffness_ * (power(indentation) - power(indentation - yield_indentation_));
  }
  return 0.0;
}

double ContactLaw::branch_slope(ContactBranch branch, ContactHistory /*history*/,
                                double indentation) const {
  switch (branch) {
    case ContactBranch::separated:
      return 0.0;
    case ContactBranch::elastic:
      return stiffness_ * power_slope(indentation);
    case ContactBranch::plastic:
      return stiffness_ *
             (power_slope(indentation) - power_slope(indentation - yield_indentation_));
  }
  return 0.0;
}

double ContactLaw::recoverable_energy(ContactHistory history, double indentation) const {
  const ContactHistory now = commit(history, indentation);
  const double residual = residual_indentation(now);
  if (indentation <= residual) return 0.0;
  return stiffness_ * (power_integral(indentation) - power_integral(residual) -
                       power(residual) * (indentation - residual));
}

double ContactLaw::indentation_at(double energy) const {
  const auto work = [this](double indentation) {
    const ContactHistory reached{indentation};
    return recoverable_energy(reached, indentation) + dissipated_energy(reached);
  };
  // Exact without yielding; yielding takes more depth for the same work.
  double low = std::pow((exponent_ + 1.0) * energy / stiffness_, 1.0 / (exponent_ + 1.0));
  if (!(work(low) < energy)) return low;
  double high = 2.0 * low;
  while (work(high) < energy) high *= 2.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (work(middle) < energy ? low : high) = middle;
  }
  return high;
}

double ContactLaw::dissipated_energy(ContactHistory history) const {
  const double residual = residual_indentation(history);
  if (residual == 0.0) return 0.0;
  return stiffness_ * power(residual) * yield_indentation_;
}

}  // namespace subimpact
