// Contacts whose indentation is measured from the mid-plane: a cylinder across the beam and a ball,
// with a constant yield pressure and with one that rises.

#include "contact/noses_on_a_beam.h"
#include "testing.h"

namespace subimpact {
namespace {

// Equation 5.57: a cylinder and the middle of a plate, d below.
TEST(LineContact, IsJohnsonsElasticContactUpToItsYield) {
  const MidPlaneContact law = line(cut_off(Nose::cylinder, 2.8));
  for (const double a : {1e-7, 1e-5, 5e-5, 1e-4}) {
    const double load = M_PI * E1 * a * a / (4.0 * R);  // per width, 4.43
    const double approach = load / (M_PI * E1) * (2.0 * std::log(2.0 * d / a) - k);
    EXPECT_NEAR(law.force({}, approach), load * width, 1e-13 * load * width) << a;
    EXPECT_NEAR(law.half_width_at(approach), a, 1e-13 * a);
  }
  EXPECT_NEAR(law.half_width_at(law.yield_threshold({})), 2.0 * R * 2.8 * Y / E1, 1e-15);
}

// Equation 5.58 gives a cylinder between two plates twice this.
TEST(LineContact, OfAnElasticNoseAddsWhatTheNoseGivesWay) {
  const MidPlaneContact law = line({}, of_steel);
  const double modulus = both(of_steel);
  for (const double a : {1e-6, 3e-5, 2e-4}) {
    const double load = M_PI * modulus * a * a / (4.0 * R);
    const double approach =
        load / M_PI *
        ((2.0 * std::log(2.0 * d / a) - k) / E1 + (2.0 * std::log(4.0 * R / a) - 1.0) / of_steel);
    EXPECT_NEAR(law.force({}, approach), load * width, 1e-13 * load * width) << a;
  }
}

TEST(LineContact, ThatYieldsHasItsPressureCutOff) {
  const double p_y = 2.8 * Y;
  const MidPlaneContact law = line(cut_off(Nose::cylinder, 2.8));
  for (const double a : {1.2e-4, 3e-4, 1e-3, 1.6e-3}) {
    // Hertz's pressure over the half width, where it is below p_y.
    const double p0 = E1 * a / (2.0 * R);
    constexpr int n = 200000;
    double load = 0.0;
    for (int i = 0; i < n; ++i) {
      const double x = (i + 0.5) / n;
      load += 2.0 * a / n * std::min(p0 * std::sqrt(1.0 - x * x), p_y);
    }
    const double lambda =
        a * a / (2.0 * R) + load / (M_PI * E1) * (2.0 * std::log(2.0 * d / a) - k - 2.0);
    EXPECT_NEAR(law.plastic_force(lambda), load * width, 1e-6 * load * width) << a;
  }
}

TEST(LineContact, EndsBeforeItsUnloadingTurnsBack) {
  for (const MidPlaneContact& law : {line(cut_off(Nose::cylinder, 2.8)), line({})}) {
    const double deepest = law.largest_indentation();
    EXPECT_NEAR(law.half_width_at(deepest), 2.0 * d * std::exp(-0.5 * (k + 2.5)), 1e-12);
    for (const double x : {0.9, 1.0, 1.1}) {  // trial steps go beyond
      EXPECT_GT(law.slope({deepest}, x * deepest), 0.0);
    }
  }
}

// Boussinesq's displacement of rings under Hertz's pressure.
double displacement_at(double depth, double a, double force) {
  constexpr int n = 20000;
  const double p0 = 1.5 * force / (M_PI * a * a);
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double v = (i + 0.5) / n;  // the pressure over p0; r dr = a^2 v dv
    const double rho = std::sqrt(depth * depth + a * a * (1.0 - v * v));
    sum += v * v / n * (depth * depth / (rho * rho * rho) + 2.0 * (1.0 - nu) / rho);
  }
  return 2.0 * M_PI * a * a * p0 * sum * (1.0 + nu) / (2.0 * M_PI * E);
}

TEST(BallContact, IsHertzsLessWhatTheHalfSpaceMovesAtTheMidPlane) {
  const MidPlaneContact law = ball({});
  for (const double a : {1e-5, 1e-4, 3.7e-4, 3.8e-4, 1e-3, 3e-3}) {
    const double force = 4.0 * E1 * a * a * a / (3.0 * R);
    const double lambda = a * a / R - displacement_at(d, a, force);
    EXPECT_NEAR(law.force({}, lambda), force, 1e-8 * force) << a;
  }
}

// Of a mass that meets the contact with `ratio` times the velocity of first yield.
double restitution(const ContactLaw& law, double ratio) {
  const double energy = law.work_up_to(law.yield_threshold({})) * ratio * ratio;
  const double deepest = law.indentation_at(energy);
  return std::sqrt(law.recoverable_energy({deepest}, deepest) / energy);
}

// Contact Mechanics, equation 11.46, of a pressure p_d and the energy of the strike.
double johnsons_restitution(double pressure, double energy) {
  return std::sqrt(0.3 * std::pow(M_PI, 1.25) * std::pow(4.0, 0.75) * pressure / E1 *
                   std::pow(energy / (pressure * R * R * R), -0.25));
}

TEST(BallContact, HasJohnsonsRestitutionDeepInThePlasticRange) {
  const MidPlaneContact sharp = ball(cut_off(Nose::ball, 1.6), INFINITY);
  const MidPlaneContact rising = ball(by_depth(Nose::ball), INFINITY);
  for (const auto& [law, pressure] : {std::pair(&sharp, 1.6 * Y), {&rising, 2.8 * Y}}) {
    double last = 1.0;
    for (const double ratio : {1e3, 1e4, 1e5}) {
      const double energy = law->work_up_to(law->yield_threshold({})) * ratio * ratio;
      const double expected = johnsons_restitution(pressure, energy);
      const double error = std::abs(restitution(*law, ratio) / expected - 1.0);
      EXPECT_LT(error, 0.35 * last) << ratio;
      last = error;
    }
    EXPECT_LT(last, 3e-3);
  }
}

TEST(MeanPressure, ByDepthBeginsAsHertzsAndRisesToThatOfTheFullyPlasticContact) {
  for (const Nose nose : {Nose::ball, Nose::cylinder}) {
    const MeanPressure pressure = *by_depth(nose);
    const double a_y = pressure.first_yield, first = pressure.beyond_it(a_y).at;
    EXPECT_NEAR(first / Y, nose == Nose::ball ? 1.07 : 1.31, 0.005);
    EXPECT_NEAR(pressure.beyond_it(a_y).slope, first / a_y, 1e-12 * first / a_y);
    double last = first;
    for (double a = 1.01 * a_y; a < 1e4 * a_y; a *= 1.05) {
      EXPECT_GE(pressure.beyond_it(a).at, (1.0 - 1e-14) * last) << a / a_y;
      last = pressure.beyond_it(a).at;
    }
    EXPECT_NEAR(last / Y, 2.8, 0.01);
  }
}

TEST(MeanPressure, ByDepthIsThatOfTheExpandingCore) {
  const auto at = [](Nose nose, double x) {  // x = E* a/(Y R)
    return by_depth(nose)->beyond_it(x * Y * R / E1).at / Y;
  };
  for (const double x : {15.0, 18.0, 20.0}) {
    const double ball_core = 0.5 + 2.0 / 3.0 * (1.0 + std::log(x / 3.0));
    EXPECT_NEAR(at(Nose::ball, x), ball_core, 0.025 * ball_core) << x;
    const double line_core = (1.0 + std::log(8.0 * x / (3.0 * M_PI))) / std::sqrt(3.0);
    EXPECT_NEAR(at(Nose::cylinder, 2.0 * x), line_core, 0.03 * line_core) << x;
  }
}

TEST(MeanPressure, RefusesWhatIsNone) {
  EXPECT_THROW(cut_off_pressure(Nose::ball, INFINITY, E1, R), std::invalid_argument);
  EXPECT_THROW(pressure_by_depth(Nose::cylinder, 0.0, E1, R), std::invalid_argument);
}

}  // namespace
}  // namespace subimpact
