// Contacts of spheres: Thornton's that yields, Hertz's where the surfaces touch in an ellipse, and
// the door through which a law is its force alone.

#include "model/contact/contact_laws.h"
#include "model/contact/power_contact.h"
#include "paper_scene.h"
#include "testing.h"

namespace subimpact {
namespace {

const double R = 0.012, modulus = 9e10, pressure = 4e8;

SphereContact steel() { return {R, modulus, pressure}; }

double yield_indentation() { return std::pow(M_PI * pressure / (2.0 * modulus), 2) * R; }

// Of two rigid bodies that meet at v_y/q (Thornton 1997).
double restitution(double q) {
  return std::sqrt(6.0 * std::sqrt(3.0) / 5.0) * std::sqrt(1.0 - q * q / 6.0) *
         std::pow(q / (q + 2.0 * std::sqrt(1.2 - 0.2 * q * q)), 0.25);
}

TEST(SphereContact, HasThorntonsRestitutionFromTheWorkOfItsForces) {
  const SphereContact law = steel();
  const auto e = [&](double ratio) {  // at that velocity over v_y
    const double energy = law.work_up_to(yield_indentation()) * ratio * ratio;
    const double deepest = law.indentation_at(energy);
    return std::sqrt(law.recoverable_energy({deepest}, deepest) / energy);
  };
  for (const double ratio : {1.01, 1.1, 1.5, 2.0, 5.0, 20.0, 100.0, 1000.0}) {
    EXPECT_NEAR(e(ratio), restitution(1.0 / ratio), 1e-11) << ratio;
  }
  // Lost as the fourth root of a great velocity.
  EXPECT_NEAR(std::log(e(1e6) / e(1e5)) / std::log(10.0), -0.25, 1e-6);
}

TEST(SphereContact, IsHertzUpToItsYield) {
  const SphereContact law = steel();
  const double stiffness = 4.0 / 3.0 * modulus * std::sqrt(R), unit = yield_indentation();
  const double force_there =
      std::pow(M_PI, 3) * R * R * std::pow(pressure, 3) / (6.0 * modulus * modulus);  // F_y
  EXPECT_NEAR(law.plastic_force(unit), force_there, 1e-14 * force_there);
  EXPECT_NEAR(law.scales().stiffness, stiffness, 1e-14 * stiffness);
  for (const double x : {1e-3, 0.1, 0.7, 1.0}) {
    const double hertz = stiffness * std::pow(x * unit, 1.5);
    EXPECT_NEAR(law.contact_force({}, x * unit), hertz, 1e-14 * hertz);
    EXPECT_NEAR(law.contact_force({0.9 * unit}, x * unit), hertz, 1e-14 * hertz);
    EXPECT_NEAR(law.recoverable_energy({x * unit}, x * unit), 0.4 * hertz * x * unit,
                1e-14 * hertz * unit);
    EXPECT_EQ(law.dissipated_energy({x * unit}), 0.0);
    EXPECT_EQ(law.residual_indentation({x * unit}), 0.0);
  }
}

// Thornton's own form: a sphere of the dent's radius R_p, shifted by delta_p.
TEST(SphereContact, UnloadsAsASphereOfTheDentsRadius) {
  const SphereContact law = steel();
  const double unit = yield_indentation(), force_there = law.plastic_force(unit);
  for (const double x : {1.1, 3.0, 50.0}) {
    const double most = law.plastic_force(x * unit);
    const double radius = 4.0 * modulus / (3.0 * most) *
                          std::pow((2.0 * most + force_there) / (2.0 * M_PI * pressure), 1.5);
    const double stiffness = 4.0 / 3.0 * modulus * std::sqrt(radius);
    const double dent = x * unit - std::pow(most / stiffness, 2.0 / 3.0);
    EXPECT_NEAR(law.residual_indentation({x * unit}), dent, 1e-12 * x * unit);
    for (const double part : {0.2, 0.6, 0.95}) {
      const double at = dent + part * (x * unit - dent);
      EXPECT_NEAR(law.contact_force({x * unit}, at), stiffness * std::pow(at - dent, 1.5),
                  1e-11 * most);
    }
  }
}

TEST(SphereContact, RefusesWhatIsNone) {
  EXPECT_THROW(SphereContact(0.0, modulus, pressure), std::invalid_argument);
  EXPECT_THROW(SphereContact(R, modulus, INFINITY), std::invalid_argument);
}

// A law with the least that a law has, beside PowerContact with its closed forms.
class ForceAlone final : public ContactLaw {
 public:
  std::string name() const override { return "force alone"; }
  double force(ContactHistory history, double x) const override { return law.force(history, x); }
  double residual_indentation(ContactHistory history) const override {
    return law.residual_indentation(history);
  }
  double yield_threshold(ContactHistory history) const override {
    return law.yield_threshold(history);
  }
  PowerContact law{3e10, 1.5, 2e-5};
};

TEST(ContactLaw, OfAForceAloneHasItsSlopesEnergiesAndScales) {
  const ForceAlone plain;
  const PowerContact& law = plain.law;
  EXPECT_NEAR(plain.scales().stiffness, 3e10, 1e-6 * 3e10);
  EXPECT_NEAR(plain.scales().exponent, 1.5, 1e-12);
  const double energy = law.work_up_to(1e-4), slope = law.largest_slope(1e-4);
  for (const double largest : {0.0, 1e-5, 3e-5, 1e-4}) {
    for (const double x : {5e-6, 1.9e-5, 9e-5}) {
      const ContactHistory history = ContactLaw::commit({largest}, x);
      EXPECT_NEAR(plain.recoverable_energy(history, x), law.recoverable_energy(history, x),
                  1e-6 * energy);
      EXPECT_NEAR(plain.dissipated_energy(history), law.dissipated_energy(history), 1e-6 * energy);
      EXPECT_NEAR(plain.slope({largest}, x), law.slope({largest}, x), 1e-8 * slope);
    }
  }
  EXPECT_NEAR(plain.plastic_slope(9e-5), law.plastic_slope(9e-5), 1e-8 * slope);
  EXPECT_FALSE(broken_rule(plain, 1e-4));
}

// Hertz's pressure p_0 sqrt(1 - x^2/a^2 - y^2/b^2) on a half space: the displacement inside the
// ellipse by quadrature over the chords through a point, each of which has a closed form.
double displacement(double a, double b, double x, double y, double p0) {
  constexpr int n = 400;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double angle = M_PI * (i + 0.5) / n, c = std::cos(angle) / a, s = std::sin(angle) / b;
    const double square = c * c + s * s, mixed = x * c / a + y * s / b;
    const double rest = 1.0 - x * x / (a * a) - y * y / (b * b) + mixed * mixed / square;
    sum += 0.5 * M_PI * rest / std::sqrt(square) * M_PI / n;
  }
  return p0 * sum / (M_PI * modulus);
}

TEST(Hertz, OfAnEllipseIsTheDisplacementUnderItsPressure) {
  for (const double axes : {1.001, 1.3, 2.0, 5.0, 12.0}) {
    const double b = 1e-3, a = axes * b, p0 = 1e9;
    const double force = 2.0 / 3.0 * M_PI * a * b * p0;
    const double approach = displacement(a, b, 0.0, 0.0, p0);
    const double along = approach - displacement(a, b, 0.5 * a, 0.0, p0);
    const double across = approach - displacement(a, b, 0.0, 0.5 * b, p0);
    const GapRadii radii{0.125 * a * a / along, 0.125 * b * b / across};
    const double expected = force / std::pow(approach, 1.5);
    EXPECT_NEAR(hertz_stiffness(radii, 1.0 / modulus), expected, 1e-9 * expected) << axes;
    EXPECT_NEAR(hertz_stiffness({radii.across, radii.along}, 1.0 / modulus), expected,
                1e-9 * expected);
  }
}

TEST(GapRadii, OfASphereOnAFlatBeamAreThoseOfACircleAtEveryHalfMillimetre) {
  Scene scene = paper_scene();
  scene.striker.nose = NoseShape::sphere;
  scene.contact = {ContactKind::sphere, {}, 2e11, 0.3, 0.33};
  for (int halves = 1; halves <= 1000; ++halves) {
    scene.striker.nose_radius = 0.5 * halves * 1e-3;
    EXPECT_EQ(gap_radii(scene).across, scene.striker.nose_radius) << halves;
    EXPECT_EQ(built_in_contact_law(ContactKind::sphere).why_not(scene, gap_radii(scene)), "");
    EXPECT_TRUE(contact_yield_velocity(scene, *make_contact_law(scene)));
  }
}

TEST(GapRadii, FollowFromNoseAndSection) {
  Scene scene = paper_scene();
  scene.striker.nose_radius = 0.01;
  EXPECT_EQ(gap_radii(scene).along, 0.01);
  EXPECT_EQ(gap_radii(scene).across, INFINITY);
  scene.striker.nose = NoseShape::sphere;
  EXPECT_EQ(gap_radii(scene).across, 0.01);
  scene.beam.section = {.shape = SectionShape::circle, .diameter = 0.02};
  EXPECT_DOUBLE_EQ(gap_radii(scene).across, 0.005);
  scene.striker.nose = NoseShape::cylinder;
  EXPECT_DOUBLE_EQ(gap_radii(scene).across, 0.01);
}

TEST(ContactYieldVelocity, IsThatOfTheEnergyUpToYieldAndHertzHasThatOfItsMaterial) {
  Scene scene = paper_scene();
  scene.contact = {ContactKind::sphere, {}, 2e11, 0.3, 0.33};
  const auto law = make_contact_law(scene);
  const double expected = std::sqrt(0.8 * law->scales().stiffness *
                                    std::pow(law->yield_threshold({}), 2.5) / scene.striker.mass);
  EXPECT_NEAR(contact_yield_velocity(scene, *law).value(), expected, 1e-12 * expected);
  scene.contact.kind = ContactKind::hertz;
  EXPECT_NEAR(contact_yield_velocity(scene, *make_contact_law(scene)).value(), expected,
              1e-12 * expected);
  scene.beam.yield_stress = INFINITY;
  EXPECT_FALSE(contact_yield_velocity(scene, *make_contact_law(scene)));
}

// Johnson, Contact Mechanics, equations 3.63 and 4.45; beyond first yield force over area.
TEST(ContactPressure, IsHertzsUpToFirstYieldAndThenTheMeanThatTheForceNeeds) {
  Scene scene = paper_scene();
  for (const ContactKind kind : {ContactKind::sphere, ContactKind::line}) {
    const bool is_ball = kind == ContactKind::sphere;
    scene.contact = {kind, {}, INFINITY, 0.3, 0.33};
    scene.contact.indentation = IndentationFrom::mid_plane;
    const double modulus = scene.beam.youngs_modulus / (1.0 - 0.33 * 0.33);
    const double R = *scene.striker.nose_radius, b = scene.beam.width;
    const double p = 1e8;  // below first yield, 1.6 and 1.67 Y
    const double a = p * R / modulus * (is_ball ? 0.5 * M_PI : 2.0);
    const double force = is_ball ? 2.0 / 3.0 * p * M_PI * a * a : 0.5 * M_PI * a * p * b;
    const auto elastic = contact_pressure(scene, force);
    ASSERT_TRUE(elastic);
    EXPECT_FALSE(elastic->is_mean);
    EXPECT_NEAR(elastic->at_force, p, 1e-9 * p);
    EXPECT_NEAR(elastic->first_yield, (is_ball ? 1.6 : 1.67) * scene.beam.yield_stress, 1.0);
    scene.contact.pressure_by_depth = true;
    const auto deep = contact_pressure(scene, 1e4);
    ASSERT_TRUE(deep && deep->is_mean);
    const MeanPressure::Nose nose =
        is_ball ? MeanPressure::Nose::ball : MeanPressure::Nose::cylinder;
    const double width =
        is_ball ? std::sqrt(1e4 / (M_PI * deep->at_force)) : 1e4 / (2.0 * b * deep->at_force);
    const MeanPressure mean = pressure_by_depth(nose, scene.beam.yield_stress, modulus, R);
    EXPECT_NEAR(mean.beyond_it(width).at, deep->at_force, 1e-9 * deep->at_force);
  }
  scene.contact = {ContactKind::hertz, 1e10, {}, {}, {}};
  EXPECT_FALSE(contact_pressure(scene, 1e3));
}

}  // namespace
}  // namespace subimpact
