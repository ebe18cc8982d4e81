#include "model/contact_laws.h"

#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace subimpact {
namespace {

using Law = std::shared_ptr<const ContactLaw>;

constexpr double never = std::numeric_limits<double>::infinity();  // as a yield indentation

double need(const std::optional<double>& constant) {
  if (!constant) throw std::invalid_argument("contact law: a constant that it needs is missing");
  return *constant;
}

Law make_foundation(const Scene& scene) {
  const Beam& beam = scene.beam;
  return std::make_shared<PowerContact>(
      4.0 * std::sqrt(2.0 * need(scene.striker.nose_radius)) * beam.youngs_modulus * beam.width /
          (3.0 * beam.thickness),
      1.5, beam.yield_stress * beam.thickness / beam.youngs_modulus, "foundation");
}

Law make_hertz(const Scene& scene) {
  const Contact& contact = scene.contact;
  const double stiffness =
      contact.stiffness
          ? *contact.stiffness
          : hertz_stiffness(need(scene.striker.nose_radius), need(contact.striker_modulus),
                            need(contact.striker_poisson), scene.beam.youngs_modulus,
                            need(scene.beam_poisson()));
  return std::make_shared<PowerContact>(stiffness, 1.5, never, "hertz");
}

Law make_linear(const Scene& scene) {
  return std::make_shared<PowerContact>(need(scene.contact.stiffness), 1.0, never, "linear");
}

constexpr const char* nose[] = {"striker.nose_radius"};
constexpr const char* stiffness[] = {"contact.stiffness"};
constexpr const char* sphere[] = {"striker.nose_radius", "contact.striker_modulus",
                                  "contact.striker_poisson", "contact.beam_poisson"};

constexpr ContactConstants of_foundation[] = {
    {nose, "give it in m",
     "\"foundation\" derives its stiffness from beam and striker.nose_radius"}};
constexpr ContactConstants of_hertz[] = {
    {stiffness, "give it in N/m^1.5",
     "contact.stiffness already sets the stiffness of the contact"},
    {sphere,
     "give it, or contact.stiffness in N/m^1.5 in place of a sphere's radius, moduli and Poisson's "
     "ratios",
     ""}};
constexpr ContactConstants of_linear[] = {
    {stiffness, "give it in N/m", "\"linear\" does not use it"}};

constexpr BuiltInContactLaw laws[] = {
    {ContactKind::foundation, "foundation", "elasto-plastic columns under a cylindrical nose",
     of_foundation, make_foundation},
    {ContactKind::hertz, "hertz",
     "elastic, K lambda^1.5: contact.stiffness, or a sphere of striker.nose_radius with the moduli "
     "and Poisson's ratios of both bodies",
     of_hertz, make_hertz},
    {ContactKind::linear, "linear", "elastic, K lambda: contact.stiffness", of_linear, make_linear},
};

}  // namespace

double hertz_stiffness(double radius, double modulus_1, double poisson_1, double modulus_2,
                       double poisson_2) {
  const double compliance = (1.0 - poisson_1 * poisson_1) / modulus_1 +
                            (1.0 - poisson_2 * poisson_2) / modulus_2;  // 1/E*
  return 4.0 / 3.0 * std::sqrt(radius) / compliance;
}

PowerContact::PowerContact(double stiffness, double exponent, double yield_indentation,
                           std::string name)
    : stiffness_(stiffness),
      exponent_(exponent),
      yield_indentation_(yield_indentation),
      name_(std::move(name)) {
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

double PowerContact::elastic_force(ContactHistory history, double indentation) const {
  return stiffness_ * (power(indentation) - power(residual_indentation(history)));
}

double PowerContact::elastic_slope(ContactHistory /*history*/, double indentation) const {
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

std::span<const BuiltInContactLaw> built_in_contact_laws() { return laws; }

const BuiltInContactLaw& built_in_contact_law(ContactKind kind) {
  for (const BuiltInContactLaw& law : laws) {
    if (law.kind == kind) return law;
  }
  throw std::logic_error("a contact law without a row: add it in contact_laws.cpp");
}

std::shared_ptr<const ContactLaw> make_contact_law(const Scene& scene) {
  return built_in_contact_law(scene.contact.kind).make(scene);
}

}  // namespace subimpact
