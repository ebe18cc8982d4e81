#include "subimpact/model/contact/contact_law.h"
#include "built_in_law.h"
#include "paper_scene.h"
#include "random_walk.h"
#include "testing.h"

namespace subimpact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

PowerContact paper_law() { return law_of(paper_scene()); }

// Histories in units of the yield indentation: never yielded, just yielded, small and deep plastic
// ones.
const double maxima[] = {0.0, 0.5, 1.0, 1.2, 2.0, 3.0, 11.0};

TEST(ContactLaw, HasTheNumbersOfThePapersExample) {
  const PowerContact law = paper_law();
  EXPECT_NEAR(law.stiffness(), 2.948976e10, 0.5e4);
  EXPECT_NEAR(law.yield_indentation(), 1.56337e-5, 0.5e-10);
  EXPECT_NEAR(law.contact_force({}, law.yield_indentation()), 1822.90, 0.005);
  EXPECT_EQ(law.exponent(), 1.5);
}

TEST(ContactLaw, OfABeamThatNeverYieldsIsAnElasticFoundation) {
  Scene scene = paper_scene();
  scene.beam.yield_stress = infinity;
  const PowerContact law = law_of(scene);
  const ContactHistory deep{1e-3};
  EXPECT_EQ(law.residual_indentation(deep), 0.0);
  EXPECT_EQ(law.branch(deep, 2e-3), ContactBranch::elastic);
  EXPECT_DOUBLE_EQ(law.contact_force(deep, 4e-4), law.stiffness() * 8e-6);
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
  EXPECT_EQ(law_of(scene).exponent(), 1.5);
  EXPECT_EQ(law_of(scene).stiffness(), 1.5e10);
  EXPECT_EQ(law_of(scene).yield_indentation(), infinity);
  scene.contact.kind = ContactKind::linear;
  EXPECT_EQ(law_of(scene).exponent(), 1.0);
  EXPECT_DOUBLE_EQ(law_of(scene).contact_force({}, 2e-5), 3e5);
  EXPECT_DOUBLE_EQ(law_of(scene).recoverable_energy({}, 2e-5), 3.0);
}

TEST(ContactLaw, OfASphereIsHertzsWithBothBodiesElastic) {
  // Timoshenko's ball and bar, of one steel: 2/3 E sqrt(R)/(1 - nu^2).
  Scene scene = paper_scene();
  scene.beam.youngs_modulus = 2.157463e11;
  scene.striker.nose_radius = 0.01;
  scene.contact = {ContactKind::hertz, {}, 2.157463e11, 0.3, 0.3};
  EXPECT_NEAR(law_of(scene).stiffness(), 1.580559e10, 0.5e4);
  // A rigid ball is twice as stiff as one of the beam's material; so is a rigid beam.
  const auto stiffness = [](double radius, double modulus_1, double modulus_2) {
    return hertz_stiffness({radius, radius}, contact_compliance(modulus_1, 0.3, modulus_2, 0.3));
  };
  const double both = stiffness(0.01, 2e11, 2e11);
  EXPECT_DOUBLE_EQ(stiffness(0.01, infinity, 2e11), 2.0 * both);
  EXPECT_DOUBLE_EQ(stiffness(0.01, 2e11, infinity), 2.0 * both);
  EXPECT_DOUBLE_EQ(stiffness(0.04, 2e11, 2e11), 2.0 * both);
}

// A mass against a wall under F = K d^n, by small Runge-Kutta steps: duration times v/d_max.
double duration_constant(double exponent) {
  const PowerContact law(1.0, exponent, infinity);
  const double d_max = std::pow(0.5 * (exponent + 1.0), 1.0 / (exponent + 1.0));
  const double h = 1e-4;
  double x = 0.0, v = 1.0, t = 0.0;
  for (;;) {
    const double x1 = x + 0.5 * h * v, v1 = v - 0.5 * h * law.contact_force({}, x);
    const double x2 = x + 0.5 * h * v1, v2 = v - 0.5 * h * law.contact_force({}, x1);
    const double x3 = x + h * v2, v3 = v - h * law.contact_force({}, x2);
    const double next = x + h / 6.0 * (v + 2.0 * v1 + 2.0 * v2 + v3);
    if (next <= 0.0) return (t - x / v) / d_max;
    v -= h / 6.0 *
         (law.contact_force({}, x) + 2.0 * law.contact_force({}, x1) +
          2.0 * law.contact_force({}, x2) + law.contact_force({}, x3));
    x = next;
    t += h;
  }
}

TEST(ContactLaw, OfAPowerHasTheClosedFormsDuration) {
  EXPECT_NEAR(duration_constant(1.5), 2.943275184, 1e-6);
  EXPECT_NEAR(duration_constant(1.0), M_PI, 1e-6);
  EXPECT_NEAR(duration_constant(2.0), 2.804364, 1e-6);
}

TEST(ContactLaw, ForceIsContinuousWhereBranchesMeet) {
  const PowerContact law = paper_law();
  const double unit = law.yield_indentation();
  const double force_unit = law.contact_force({}, unit);
  for (const double maximum : maxima) {
    const ContactHistory history{maximum * unit};
    const double residual = law.residual_indentation(history);
    const double threshold = law.yield_threshold(history);
    EXPECT_EQ(law.branch(history, residual), ContactBranch::separated);
    EXPECT_EQ(law.branch(history, std::nextafter(residual, 1.0)), ContactBranch::elastic);
    EXPECT_EQ(law.branch(history, threshold), ContactBranch::elastic);
    EXPECT_EQ(law.branch(history, std::nextafter(threshold, 1.0)), ContactBranch::plastic);
    EXPECT_NEAR(law.branch_force(ContactBranch::elastic, history, residual), 0.0,
                1e-13 * force_unit);
    EXPECT_NEAR(law.branch_force(ContactBranch::elastic, history, threshold),
                law.branch_force(ContactBranch::plastic, history, threshold), 1e-13 * force_unit);
  }
}

TEST(ContactLaw, SlopeJumpsWhereContactBeginsAndWhereUnloadingBegins) {
  const PowerContact law = paper_law();
  const ContactHistory history{3.0 * law.yield_indentation()};
  const double residual = law.residual_indentation(history);
  EXPECT_NEAR(law.branch_slope(ContactBranch::elastic, history, residual),
              1.5 * law.stiffness() * std::sqrt(residual), 1e-12 * law.stiffness());
  EXPECT_EQ(law.branch_slope(ContactBranch::separated, history, residual), 0.0);
  EXPECT_GT(law.branch_slope(ContactBranch::elastic, history, history.max_indentation),
            2.0 * law.branch_slope(ContactBranch::plastic, history, history.max_indentation));
}

TEST(ContactLaw, SlopeOfEveryBranchEqualsFiniteDifferencesOfItsForce) {
  for (const double exponent : {1.0, 1.5, 2.2}) {
    const double yields_at = 1.0;
    const PowerContact law(2.0, exponent, yields_at);
    for (const double maximum : maxima) {
      const ContactHistory history{maximum};
      for (double indentation = -0.5; indentation < 12.0; indentation += 0.137) {
        for (const ContactBranch branch :
             {ContactBranch::separated, ContactBranch::elastic, ContactBranch::plastic}) {
          const double h = 1e-5;
          // Where a power's argument changes sign its curvature is not bounded.
          const double beyond = indentation - yields_at;
          if (std::abs(indentation) < 0.05 || std::abs(beyond) < 0.05) continue;
          const double difference = (law.branch_force(branch, history, indentation + h) -
                                     law.branch_force(branch, history, indentation - h)) /
                                    (2.0 * h);
          EXPECT_NEAR(law.branch_slope(branch, history, indentation), difference, 2e-7);
        }
      }
    }
  }
}

TEST(ContactLaw, NeverPulls) {
  const PowerContact law = paper_law();
  const double unit = law.yield_indentation();
  for (const double maximum : maxima) {
    for (double x = -5.0; x < 15.0; x += 0.01)
      EXPECT_GE(law.contact_force({maximum * unit}, x * unit), 0.0);
  }
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

// Work done on the contact along a straight path, by Simpson's rule in parts between which the
// force is smooth.
double work_along(const ContactLaw& law, ContactHistory history, double from, double to) {
  std::vector<double> knots{from, to};
  for (const double knot : {law.residual_indentation(history), law.yield_threshold(history)}) {
    if ((knot - from) * (knot - to) < 0.0) knots.push_back(knot);
  }
  std::sort(knots.begin(), knots.end(),
            [&](double a, double b) { return (b - a) * (to - from) > 0.0; });
  double work = 0.0;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const int n = 200;
    const double h = (knots[i + 1] - knots[i]) / n;
    for (int k = 0; k < n; ++k) {
      const double a = knots[i] + k * h;
      work += h / 6.0 *
              (law.contact_force(history, a) + 4.0 * law.contact_force(history, a + 0.5 * h) +
               law.contact_force(history, a + h));
    }
  }
  return work;
}

TEST(ContactLaw, RecoverablePlusDissipatedEnergyIsTheWorkDoneOnAnyPath) {
  const PowerContact law = paper_law();
  const double unit = law.yield_indentation();
  for (unsigned seed = 0; seed < 20; ++seed) {
    ContactHistory history;
    double at = 0.0, work = 0.0;
    for (const double next : nested_walk(seed, 200, -unit, 15.0 * unit, 6.0 * unit)) {
      work += work_along(law, history, at, next);
      at = next;
      history = law.commit(history, at);
      const double stored = law.recoverable_energy(history, at) + law.dissipated_energy(history);
      ASSERT_NEAR(stored, work, 1e-6 * std::max(work, 1e-3)) << "seed " << seed;
    }
  }
}

TEST(ContactLaw, WorkOverAnyClosedPathIsNotNegative) {
  const PowerContact law = paper_law();
  const double unit = law.yield_indentation();
  for (unsigned seed = 0; seed < 50; ++seed) {
    ContactHistory history;
    double at = 0.0, work = 0.0;
    std::vector<double> path = nested_walk(seed, 50, -unit, 15.0 * unit, 8.0 * unit);
    path.push_back(0.0);
    for (const double next : path) {
      work += work_along(law, history, at, next);
      at = next;
      history = law.commit(history, at);
    }
    EXPECT_GE(work, -1e-9);
    if (history.max_indentation > 1.01 * unit) {
      EXPECT_GT(work, 0.0);
    }
  }
}

TEST(ContactLaw, DissipatesResidualToThreeHalvesTimesStiffnessAndYieldIndentation) {
  const PowerContact law = paper_law();
  const double unit = law.yield_indentation();
  for (const double x : {1.0, 1.1, 2.0, 5.0, 20.0}) {
    const ContactHistory history{x * unit};
    EXPECT_NEAR(law.dissipated_energy(history),
                law.stiffness() * std::pow((x - 1.0) * unit, 1.5) * unit,
                1e-13 * law.stiffness() * std::pow(unit, 2.5));
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

TEST(ContactLaw, BreaksNoRuleWhetherItYieldsOrNot) {
  for (const double exponent : {1.0, 1.5, 2.5}) {
    for (const double yields_at : {1e-5, 1e-4, infinity}) {
      for (const double depth : {1e-6, 1e-4, 1e-2}) {
        const auto broken = broken_rule(PowerContact(1e9, exponent, yields_at), depth);
        EXPECT_FALSE(broken) << exponent << ' ' << yields_at << ' ' << depth << ' ' << *broken;
      }
    }
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
