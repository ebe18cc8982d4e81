#include "model/contact_laws.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "numerics/bracketed_root.h"

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
  const double depth = beam.height(), radius = need(scene.striker.nose_radius);
  const double yields_at = beam.yield_stress * depth / beam.youngs_modulus;
  const GapRadii radii = gap_radii(scene);
  if (std::isinf(radii.across)) {
    return std::make_shared<PowerContact>(4.0 * std::sqrt(2.0 * radius) * beam.youngs_modulus *
                                              beam.outer_solid().width / (3.0 * depth),
                                          1.5, yields_at, "foundation");
  }
  return std::make_shared<PowerContact>(
      M_PI * std::sqrt(radii.along * radii.across) * beam.youngs_modulus / depth, 2.0, yields_at,
      "foundation");
}

double compliance_of(const Scene& scene) {
  return contact_compliance(need(scene.contact.striker_modulus),
                            need(scene.contact.striker_poisson), scene.beam.youngs_modulus,
                            need(scene.beam_poisson()));
}

Law make_hertz(const Scene& scene) {
  const auto& given = scene.contact.stiffness;
  return std::make_shared<PowerContact>(
      given ? *given : hertz_stiffness(gap_radii(scene), compliance_of(scene)), 1.5, never,
      "hertz");
}

double yield_pressure_of(const Scene& scene) {
  return scene.contact.yield_pressure.value_or(yield_pressure_over_stress *
                                               scene.beam.yield_stress);
}

Law make_sphere(const Scene& scene) {
  const double radius = need(scene.striker.nose_radius), compliance = compliance_of(scene);
  const double pressure = yield_pressure_of(scene);
  if (std::isfinite(pressure)) {
    return std::make_shared<SphereContact>(radius, 1.0 / compliance, pressure);
  }
  return std::make_shared<PowerContact>(hertz_stiffness({radius, radius}, compliance), 1.5, never,
                                        "sphere");
}

Law make_linear(const Scene& scene) {
  return std::make_shared<PowerContact>(need(scene.contact.stiffness), 1.0, never, "linear");
}

constexpr const char* nose[] = {"striker.nose_radius"};
constexpr const char* stiffness[] = {"contact.stiffness"};
constexpr const char* sphere[] = {"striker.nose_radius", "contact.striker_modulus",
                                  "contact.striker_poisson", "contact.beam_poisson"};

constexpr const char* yield_pressure[] = {"contact.yield_pressure"};

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

constexpr ContactConstants of_sphere[] = {
    {sphere, "give it", "\"sphere\" derives its stiffness from radius, moduli and Poisson's ratios",
     yield_pressure}};

constexpr const char* line_contact =
    "a cylinder on a flat surface touches it along a line, whose approach is no power of the "
    "force; allowed: striker.nose = \"sphere\", or contact.law = \"foundation\"";

std::string why_no_columns(const Scene& scene, GapRadii /*radii*/) {
  if (scene.beam.gap().area() <= 0.0) return {};
  return "columns through the whole height carry the contact, and this section is hollow; allowed: "
         "contact.law = \"sphere\" or \"hertz\", which have their own stiffness";
}

std::string why_no_power(const Scene& scene, GapRadii radii) {
  return !scene.contact.stiffness && std::isinf(radii.across) ? line_contact : "";
}

std::string why_no_circle(const Scene& /*scene*/, GapRadii radii) {
  if (std::isinf(radii.across)) return line_contact;
  if (!(radii.along != radii.across)) return {};
  return "nose and surface touch in an ellipse, and the law is for a circle; allowed: \"hertz\", "
         "which has the ellipse and does not yield, or a flat surface";
}

constexpr BuiltInContactLaw laws[] = {
    {ContactKind::foundation, "foundation",
     "columns of the beam's height, elastic-perfectly plastic", true, of_foundation,
     make_foundation, why_no_columns},
    {ContactKind::hertz, "hertz",
     "elastic, K lambda^1.5: contact.stiffness, or a sphere of striker.nose_radius with the moduli "
     "and Poisson's ratios of both bodies",
     false, of_hertz, make_hertz, why_no_power},
    {ContactKind::linear, "linear", "elastic, K lambda: contact.stiffness", false, of_linear,
     make_linear},
    {ContactKind::sphere, "sphere",
     "a sphere of striker.nose_radius with the moduli and Poisson's ratios of both bodies, which "
     "yields at contact.yield_pressure (Thornton)",
     true, of_sphere, make_sphere, why_no_circle},
};

}  // namespace

double contact_compliance(double modulus_1, double poisson_1, double modulus_2, double poisson_2) {
  return (1.0 - poisson_1 * poisson_1) / modulus_1 + (1.0 - poisson_2 * poisson_2) / modulus_2;
}

GapRadii gap_radii(const Scene& scene) {
  const double nose = scene.striker.nose_radius.value_or(std::nan(""));
  const double across = (scene.nose() == NoseShape::sphere ? 1.0 / nose : 0.0) +
                        (scene.beam.is_round() ? 2.0 / scene.beam.height() : 0.0);
  return {nose, 1.0 / across};
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

std::optional<double> contact_yield_velocity(const Scene& scene, const ContactLaw& law) {
  double energy = law.work_up_to(law.yield_threshold({}));
  if (std::isinf(law.yield_threshold({}))) {
    const auto& radius = scene.striker.nose_radius;
    const double pressure = yield_pressure_of(scene);
    if (scene.contact.kind != ContactKind::hertz || !radius || std::isinf(pressure)) return {};
    const GapRadii radii = gap_radii(scene);
    if (radii.along != radii.across) return {};
    const double modulus = 0.75 * law.scales().stiffness / std::sqrt(*radius);
    const SphereContact yielding(*radius, modulus, pressure);
    energy = yielding.work_up_to(yielding.yield_threshold({}));
  }
  return std::sqrt(2.0 * energy / scene.striker.mass);
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
