#include "subimpact/model/contact/contact_law.h"
#include "built_in_law.h"
#include "paper_scene.h"
#include "random_walk.h"
#include "testing.h"

namespace subimpact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

PowerContact paper_law() { return law_of(paper_scene()); }

TEST(ContactLaw, HasTheNumbersOfThePapersExample) {
  const PowerContact law = paper_law();
  EXPECT_NEAR(law.scales().stiffness, 2.948976e10, 0.5e4);
  EXPECT_NEAR(law.yield_indentation(), 1.56337e-5, 0.5e-10);
  EXPECT_NEAR(law.contact_force({}, law.yield_indentation()), 1822.90, 0.005);
  EXPECT_EQ(law.scales().exponent, 1.5);
}

TEST(ContactLaw, OfABeamThatNeverYieldsIsAnElasticFoundation) {
  Scene scene = paper_scene();
  scene.beam.yield_stress = infinity;
  const PowerContact law = law_of(scene);
  const ContactHistory deep{1e-3};
  EXPECT_EQ(law.residual_indentation(deep), 0.0);
  EXPECT_EQ(law.branch(deep, 2e-3), ContactBranch::elastic);
  EXPECT_DOUBLE_EQ(law.contact_force(deep, 4e-4), law.scales().stiffness * 8e-6);
  EXPECT_EQ(law.dissipated_energy(deep), 0.0);
}

TEST(ContactLaw, WithAnotherExponentIsThePowerLawOfThatExponent) {
  for (const double exponent : {1.0, 1.5, 2.0, 2.5}) {
    const PowerContact law(3.0, exponent, infinity);
    for (const double indentation : {0.1, 1.0, 7.0}) {
      EXPECT_NEAR(law.contact_force({}, indentation), 3.0 * std::pow(indentation, exponent),
                  1e-12 * law.contact_force({}, indentation));
      EXPECT_NEAR(law.recoverable_energy({}, indentation),
                  3.0 * std::pow(indentation, exponent + 1.0) / (exponent + 1.0),
                  1e-12 * law.recoverable_energy({}, indentation));
    }
  }
}

TEST(ContactLaw, OfASceneIsHertzOrLinearWhereAsked) {
  Scene scene = paper_scene();
  scene.striker.nose_radius.reset();
  EXPECT_THROW(law_of(scene), std::invalid_argument);
  scene.contact.kind = ContactKind::hertz;
  EXPECT_THROW(law_of(scene), std::invalid_argument);
  scene.contact.stiffness = 1.5e10;
  EXPECT_EQ(law_of(scene).scales().exponent, 1.5);
  EXPECT_EQ(law_of(scene).scales().stiffness, 1.5e10);
  EXPECT_EQ(law_of(scene).yield_indentation(), infinity);
  scene.contact.kind = ContactKind::linear;
  EXPECT_EQ(law_of(scene).scales().exponent, 1.0);
  EXPECT_DOUBLE_EQ(law_of(scene).contact_force({}, 2e-5), 3e5);
  EXPECT_DOUBLE_EQ(law_of(scene).recoverable_energy({}, 2e-5), 3.0);
}

TEST(ContactLaw, OfASphereIsHertzsWithBothBodiesElastic) {
  // Timoshenko's ball and bar, of one steel: 2/3 E sqrt(R)/(1 - nu^2).
  Scene scene = paper_scene();
  scene.beam.youngs_modulus = 2.157463e11;
  scene.striker.nose_radius = 0.01;
  scene.contact = {ContactKind::hertz, {}, 2.157463e11, 0.3, 0.3};
  EXPECT_NEAR(law_of(scene).scales().stiffness, 1.580559e10, 0.5e4);
  // A rigid ball is twice as stiff as one of the beam's material; so is a rigid beam.
  const auto stiffness = [](double radius, double modulus_1, double modulus_2) {
    return hertz_stiffness({radius, radius}, contact_compliance(modulus_1, 0.3, modulus_2, 0.3));
  };
  const double both = stiffness(0.01, 2e11, 2e11);
  EXPECT_DOUBLE_EQ(stiffness(0.01, infinity, 2e11), 2.0 * both);
  EXPECT_DOUBLE_EQ(stiffness(0.01, 2e11, infinity), 2.0 * both);
  EXPECT_DOUBLE_EQ(stiffness(0.04, 2e11, 2e11), 2.0 * both);
}

TEST(ContactLaw, HistoryKeepsTheLargestIndentationOnly) {
  const PowerContact law = paper_law();
  ContactHistory history;
  double largest = 0.0;
  for (const double indentation : nested_walk(5, 2000, -3e-5, 2e-4, 5e-5)) {
    history = law.commit(history, indentation);
    largest = std::max(largest, indentation);
    ASSERT_EQ(history.max_indentation, largest);
  }
}

TEST(ContactLaw, DissipatesResidualToThreeHalvesTimesStiffnessAndYieldIndentation) {
  const PowerContact law = paper_law();
  const double unit = law.yield_indentation();
  for (const double x : {1.0, 1.1, 2.0, 5.0, 20.0}) {
    const ContactHistory history{x * unit};
    EXPECT_NEAR(law.dissipated_energy(history),
                law.scales().stiffness * std::pow((x - 1.0) * unit, 1.5) * unit,
                1e-13 * law.scales().stiffness * std::pow(unit, 2.5));
  }
}

TEST(ContactLaw, GivesBackTheRestitutionOfTheElastoPlasticLayer) {
  const PowerContact law = paper_law();
  const double unit = law.yield_indentation();
  const struct {
    double x, restitution;
  } published[] = {{1.1, 0.968271}, {1.5, 0.810718},  {2.0, 0.680556},  {3.0, 0.536678},
                   {5.0, 0.404029}, {10.0, 0.279676}, {20.0, 0.195686}, {50.0, 0.122987}};
  for (const auto& [x, restitution] : published) {
    const ContactHistory history{x * unit};
    const double recovered = law.recoverable_energy(history, x * unit);
    const double spent = recovered + law.dissipated_energy(history);
    EXPECT_NEAR(std::sqrt(recovered / spent), restitution, 0.6e-6) << "x = " << x;
  }
}

TEST(ContactLaw, RefusesWhatIsNoContactLaw) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double stiffness : {0.0, -1.0, infinity, nan}) {
    EXPECT_THROW(PowerContact(stiffness, 1.5, 1.0), std::invalid_argument) << stiffness;
  }
  EXPECT_THROW(PowerContact(1.0, 0.9, 1.0), std::invalid_argument);
  EXPECT_THROW(PowerContact(1.0, nan, 1.0), std::invalid_argument);
  EXPECT_THROW(PowerContact(1.0, 1.5, 0.0), std::invalid_argument);
  EXPECT_THROW(PowerContact(1.0, 1.5, nan), std::invalid_argument);
  EXPECT_NO_THROW(PowerContact(1.0, 1.0, infinity));
}

}  // namespace
}  // namespace subimpact
