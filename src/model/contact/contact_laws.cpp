#include "model/contact/contact_laws.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "model/contact/curve_contact.h"
#include "model/contact/mid_plane_contact.h"
#include "model/contact/power_contact.h"
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

namespace {

using Law = std::shared_ptr<const ContactLaw>;

constexpr double never = std::numeric_limits<double>::infinity();  // as a yield indentation
constexpr double rigid = std::numeric_limits<double>::infinity();  // as a modulus

bool is_rigid_plane(const Beam& beam) { return beam.fixed && beam.youngs_modulus == 0.0; }

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
                                          1.5, yields_at, "foundation", ContactLaw::Limit::height);
  }
  return std::make_shared<PowerContact>(
      M_PI * std::sqrt(radii.along * radii.across) * beam.youngs_modulus / depth, 2.0, yields_at,
      "foundation", ContactLaw::Limit::height);
}

double compliance_of(const Scene& scene) {
  const Contact& contact = scene.contact;
  return contact_compliance(
      contact.striker_modulus.value_or(rigid), contact.striker_poisson.value_or(0.0),
      is_rigid_plane(scene.beam) ? rigid : scene.beam.youngs_modulus, need(scene.beam_poisson()));
}

double yield_pressure_of(const Scene& scene) {
  const double share = scene.contact.kind == ContactKind::line ? yield_pressure_over_stress_of_line
                                                               : yield_pressure_over_stress;
  return scene.contact.yield_pressure.value_or(share * scene.beam.yield_stress);
}

// R of the contact: of a touch in an ellipse the geometric mean.
double radius_of(const Scene& scene) {
  const double nose = need(scene.striker.nose_radius);
  const GapRadii radii = gap_radii(scene);
  return radii.is_ellipse() ? std::sqrt(radii.along * radii.across) : nose;
}

// The pressure of a plastic contact; nothing where it does not yield.
std::optional<MeanPressure> mean_pressure_of(const Scene& scene, MeanPressure::Nose nose) {
  const double pressure = yield_pressure_of(scene);
  if (scene.contact.kind == ContactKind::hertz || std::isinf(pressure)) return std::nullopt;
  const double radius = radius_of(scene), modulus = 1.0 / compliance_of(scene);
  return scene.contact.pressure_by_depth
             ? pressure_by_depth(nose, scene.beam.yield_stress, modulus, radius)
             : cut_off_pressure(nose, pressure, modulus, radius);
}

Law make_ball(const Scene& scene, const char* name) {
  const GapRadii radii = gap_radii(scene);
  const double radius = radius_of(scene);
  const double of_ellipse =
      radii.is_ellipse()
          ? std::pow(hertz_stiffness({radius, radius}, 1.0) / hertz_stiffness(radii, 1.0),
                     2.0 / 3.0)
          : 1.0;
  const BodiesOfBall bodies{radius,
                            scene.contact.is_from_mid_plane() ? 0.5 * scene.beam.height() : never,
                            scene.beam.youngs_modulus,
                            need(scene.beam_poisson()),
                            1.0 / compliance_of(scene),
                            of_ellipse};
  return std::make_shared<MidPlaneContact>(name, ball_on_beam(bodies),
                                           mean_pressure_of(scene, MeanPressure::Nose::ball));
}

Law make_hertz(const Scene& scene) {
  const auto& given = scene.contact.stiffness;
  if (!given && scene.contact.is_from_mid_plane()) return make_ball(scene, "hertz");
  return std::make_shared<PowerContact>(
      given ? *given : hertz_stiffness(gap_radii(scene), compliance_of(scene)), 1.5, never,
      "hertz");
}

Law make_sphere(const Scene& scene) {
  const Contact& contact = scene.contact;
  if (contact.is_from_mid_plane() || contact.pressure_by_depth) return make_ball(scene, "sphere");
  const double radius = need(scene.striker.nose_radius), compliance = compliance_of(scene);
  const double pressure = yield_pressure_of(scene);
  if (std::isfinite(pressure)) {
    return std::make_shared<SphereContact>(radius, 1.0 / compliance, pressure);
  }
  return std::make_shared<PowerContact>(hertz_stiffness({radius, radius}, compliance), 1.5, never,
                                        "sphere");
}

Law make_line(const Scene& scene) {
  const Contact& contact = scene.contact;
  const double poisson = need(scene.beam_poisson()),
               of_nose = contact.striker_poisson.value_or(0.0);
  const BodiesOfLine bodies{need(scene.striker.nose_radius),
                            scene.beam.outer_solid().width,
                            0.5 * scene.beam.height(),
                            scene.beam.youngs_modulus / (1.0 - poisson * poisson),
                            poisson,
                            contact.striker_modulus.value_or(rigid) / (1.0 - of_nose * of_nose)};
  return std::make_shared<MidPlaneContact>("line", cylinder_across(bodies),
                                           mean_pressure_of(scene, MeanPressure::Nose::cylinder));
}

Law make_linear(const Scene& scene) {
  return std::make_shared<PowerContact>(need(scene.contact.stiffness), 1.0, never, "linear");
}

Law make_curve(const Scene& scene) {
  const auto given = [&](const std::optional<std::vector<double>> Contact::*list) {
    return (scene.contact.*list).value_or(std::vector<double>());
  };
  return std::make_shared<CurveContact>(
      MeasuredCurve{given(&Contact::curve_indentation), given(&Contact::curve_force)},
      MeasuredCurve{given(&Contact::unloading_indentation), given(&Contact::unloading_force)});
}

constexpr const char* nose[] = {"striker.nose_radius"};
constexpr const char* stiffness[] = {"contact.stiffness"};
constexpr const char* both_bodies[] = {"striker.nose_radius", "contact.striker_modulus",
                                       "contact.striker_poisson", "contact.beam_poisson"};
constexpr const char* beam_alone[] = {"striker.nose_radius", "contact.beam_poisson"};

constexpr const char* yield_pressure[] = {"contact.yield_pressure"};

constexpr const char* loading[] = {"contact.curve_indentation", "contact.curve_force"};
constexpr const char* unloading[] = {"contact.unloading_indentation", "contact.unloading_force"};

constexpr ContactConstants of_curve[] = {{loading, "give the points of the measured curve",
                                          "\"curve\" follows the measured points alone",
                                          unloading}};
constexpr ContactConstants of_foundation[] = {
    {nose, "give it in m",
     "\"foundation\" derives its stiffness from beam and striker.nose_radius"}};
constexpr ContactConstants of_hertz[] = {
    {stiffness, "give it in N/m^1.5",
     "contact.stiffness already sets the stiffness of the contact"},
    {both_bodies,
     "give it, or contact.stiffness in N/m^1.5 in place of a sphere's radius, moduli and Poisson's "
     "ratios",
     ""}};
constexpr ContactConstants of_linear[] = {
    {stiffness, "give it in N/m", "\"linear\" does not use it"}};

constexpr const char* from_radius =
    "\"sphere\" and \"line\" derive their stiffness from radius, moduli and Poisson's ratios";
// The second way is that of a rigid nose.
constexpr ContactConstants of_round_nose[] = {
    {both_bodies, "give it", from_radius, yield_pressure},
    {beam_alone, "give it",
     "the contact's stiffness follows from the beam, and from the nose only where both "
     "contact.striker_modulus and contact.striker_poisson are given (else it is rigid)",
     yield_pressure}};

constexpr const char* line_contact =
    "a cylinder on a flat surface touches it along a line, whose approach is no power of the "
    "force; allowed: striker.nose = \"sphere\", or contact.law = \"line\" or \"foundation\"";

constexpr const char* ellipse =
    "nose and surface touch in an ellipse, and the law is for a circle or a line; allowed: "
    "contact.indentation = \"half-space\" with contact.law = \"hertz\", which does not yield, or "
    "\"sphere\" with contact.yield_pressure = \"by-depth\"; or a flat surface";

constexpr const char* rigid_plane =
    "beam.youngs_modulus is missing: the plane is rigid; allowed on it: \"linear\" or \"hertz\" "
    "with contact.stiffness, \"curve\", and with contact.striker_modulus and "
    "contact.striker_poisson \"sphere\" or \"hertz\" with contact.indentation = \"half-space\"";

constexpr const char* no_thickness =
    "the law follows the thickness of what is struck, and the plane has no size; allowed: "
    "beam.thickness and beam.width, or, with striker.nose = \"sphere\", contact.law = \"hertz\" or "
    "\"sphere\" with contact.indentation = \"half-space\"";

// Why there is no mid-plane to measure from; empty where there is.
std::string why_no_mid_plane(const Scene& scene, GapRadii radii) {
  if (is_rigid_plane(scene.beam)) return rigid_plane;
  if (scene.beam.height() == 0.0) return no_thickness;
  if (scene.beam.gap().area() > 0.0) {
    return "the indentation is measured from the mid-plane, and this section is hollow; allowed: "
           "contact.law = \"sphere\" or \"hertz\" with contact.indentation = \"half-space\"";
  }
  return radii.is_ellipse() ? ellipse : "";
}

std::string why_no_columns(const Scene& scene, GapRadii /*radii*/) {
  if (is_rigid_plane(scene.beam)) return rigid_plane;
  if (scene.beam.height() == 0.0) return no_thickness;
  if (scene.beam.gap().area() <= 0.0) return {};
  return "columns through the whole height carry the contact, and this section is hollow; allowed: "
         "contact.law = \"sphere\" or \"hertz\", which have their own stiffness";
}

std::string why_no_power(const Scene& scene, GapRadii radii) {
  if (scene.contact.stiffness) return {};
  if (std::isinf(radii.across)) return line_contact;
  return scene.contact.is_from_mid_plane() ? why_no_mid_plane(scene, radii) : "";
}

std::string why_no_circle(const Scene& scene, GapRadii radii) {
  if (std::isinf(radii.across)) return line_contact;
  if (scene.contact.is_from_mid_plane()) return why_no_mid_plane(scene, radii);
  if (is_rigid_plane(scene.beam) && !scene.contact.striker_modulus) return rigid_plane;
  return scene.contact.pressure_by_depth || !radii.is_ellipse() ? "" : ellipse;
}

std::string why_no_line(const Scene& scene, GapRadii /*radii*/) {
  if (scene.contact.indentation == IndentationFrom::half_space) {
    return "contact.indentation is \"half-space\", on which a line contact has no finite "
           "indentation; allowed: contact.indentation = \"mid-plane\"; leave it out";
  }
  if (scene.nose() == NoseShape::sphere) {
    return "a sphere does not touch along a line; allowed: striker.nose = \"cylinder\", or "
           "contact.law = \"sphere\" or \"hertz\"";
  }
  const std::string hollow = why_no_mid_plane(scene, {});
  return hollow.empty() && scene.beam.is_round() ? ellipse : hollow;
}

std::string why_no_curve(const Scene& scene, GapRadii /*radii*/) {
  try {
    make_curve(scene);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
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
     true, of_round_nose, make_sphere, why_no_circle},
    {ContactKind::line, "line",
     "a cylinder of striker.nose_radius across the beam, with the moduli and Poisson's ratios of "
     "both bodies, which yields at contact.yield_pressure",
     true, of_round_nose, make_line, why_no_line},
    {ContactKind::curve, "curve",
     "measured: contact.curve_indentation and contact.curve_force, and for unloading "
     "contact.unloading_indentation and contact.unloading_force",
     true, of_curve, make_curve, why_no_curve},
};

}  // namespace

std::optional<double> contact_yield_velocity(const Scene& scene, const ContactLaw& law) {
  double energy = law.work_up_to(law.yield_threshold({}));
  if (std::isinf(law.yield_threshold({}))) {
    const auto& radius = scene.striker.nose_radius;
    const double pressure = yield_pressure_of(scene);
    if (scene.contact.kind != ContactKind::hertz || !radius || std::isinf(pressure)) return {};
    const GapRadii radii = gap_radii(scene);
    if (!radii.is_circle()) return {};
    const double modulus = 0.75 * law.scales().stiffness / std::sqrt(*radius);
    const SphereContact yielding(*radius, modulus, pressure);
    energy = yielding.work_up_to(yielding.yield_threshold({}));
  }
  return std::sqrt(2.0 * energy / scene.striker.mass);
}

std::optional<ContactPressure> contact_pressure(const Scene& scene, double force) {
  const Contact& contact = scene.contact;
  const bool is_line = contact.kind == ContactKind::line;
  const bool is_ball = contact.kind == ContactKind::sphere || contact.kind == ContactKind::hertz;
  if (contact.stiffness || !(is_line || is_ball) || !scene.striker.nose_radius) return {};
  const double radius = radius_of(scene), modulus = 1.0 / compliance_of(scene);
  const double width = scene.beam.outer_solid().width;
  const double elastic = is_line
                             ? std::sqrt(force * modulus / (M_PI * radius * width))
                             : std::cbrt(6.0 * force * modulus * modulus / radius / radius) / M_PI;
  const auto nose = is_line ? MeanPressure::Nose::cylinder : MeanPressure::Nose::ball;
  const std::optional<MeanPressure> mean = mean_pressure_of(scene, nose);
  if (!mean) return ContactPressure{elastic, false, never};
  const double first = (is_line ? 0.5 : 2.0 / M_PI) * modulus * mean->first_yield / radius;
  if (elastic <= first) return ContactPressure{elastic, false, first};
  const auto carried = [&](double a) {
    return (is_line ? 2.0 * width * a : M_PI * a * a) * mean->beyond_it(a).at;
  };
  const auto lacking = [&](double a) { return carried(a) - force; };
  double wide = 2.0 * mean->first_yield;
  while (lacking(wide) < 0.0) wide *= 2.0;
  return ContactPressure{mean->beyond_it(root_in(lacking, mean->first_yield, wide)).at, true,
                         first};
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
