// Contacts whose indentation is measured from the mid-plane: a cylinder across the beam and a ball,
// with a constant yield pressure and with one that rises.

#include "model/contact/mid_plane_contact.h"

#include "testing.h"

namespace subimpact {
namespace {

using Nose = MeanPressure::Nose;

const double R = 0.01, width = 0.0163, d = 0.00375, nu = 0.33, E = 72e9, Y = 150e6;
const double E1 = E / (1.0 - nu * nu), k = nu / (1.0 - nu);
const double rigid = std::numeric_limits<double>::infinity();
const double of_steel = 210e9 / (1.0 - 0.09);

double both(double of_nose) { return 1.0 / (1.0 / E1 + 1.0 / of_nose); }

using Pressure = std::optional<MeanPressure>;

MidPlaneContact line(Pressure pressure, double of_nose = rigid) {
  return {"line", cylinder_across({R, width, d, E1, nu, of_nose}), pressure};
}

MidPlaneContact ball(Pressure pressure, double depth = d, double of_nose = rigid) {
  return {"sphere", ball_on_beam({R, depth, E, nu, both(of_nose)}), pressure};
}

Pressure cut_off(Nose nose, double of_yield_stress, double of_nose = rigid) {
  return cut_off_pressure(nose, of_yield_stress * Y, both(of_nose), R);
}
Pressure by_depth(Nose nose, double of_nose = rigid) {
  return pressure_by_depth(nose, Y, both(of_nose), R);
}

/// Every law and variant, with a depth (m) to which it is looked at.
struct Variant {
  const char* name;
  MidPlaneContact law;
  double deepest;
};

std::vector<Variant> variants() {
  std::vector<Variant> all;
  const auto add = [&](const char* name, MidPlaneContact law, double deepest) {
    all.push_back({name, std::move(law), deepest});
  };
  add("line, elastic", line({}), 5e-5);
  add("line, cut off", line(cut_off(Nose::cylinder, 2.8)), 1.4e-4);
  add("line, cut off early", line(cut_off(Nose::cylinder, 1.67)), 1.2e-4);
  add("line, both elastic", line(cut_off(Nose::cylinder, 2.8, of_steel), of_steel), 1.4e-4);
  add("line, by depth", line(by_depth(Nose::cylinder)), 1.3e-4);
  add("ball, elastic", ball({}), 2e-4);
  add("ball, cut off", ball(cut_off(Nose::ball, 2.8)), 4e-4);
  add("ball, both elastic", ball(cut_off(Nose::ball, 1.6, of_steel), d, of_steel), 4e-4);
  add("ball, by depth", ball(by_depth(Nose::ball)), 4e-4);
  add("ball on a half-space", ball(cut_off(Nose::ball, 1.6), INFINITY), 4e-4);
  add("ball on a half-space, by depth", ball(by_depth(Nose::ball), INFINITY), 4e-4);
  add("touch in an ellipse, by depth",
      {"sphere", ball_on_beam({R, INFINITY, E, nu, both(rigid), 0.9}), by_depth(Nose::ball)}, 4e-4);
  return all;
}

// Depths from that of first yield on, and where nothing yields.
std::vector<double> depths_of(const Variant& of) {
  const double first = std::min(of.law.yield_threshold({}), of.deepest);
  std::vector<double> depths;
  for (const double part : {0.0, 0.01, 0.1, 0.5, 1.0}) {
    depths.push_back(first + part * (of.deepest - first));
  }
  return depths;
}

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

TEST(BallContact, TakesThreeQuartersOfRadiusOverDepthOfHertzsIndentation) {
  const MidPlaneContact law = ball({});
  const double lambda = 1e-9, a = law.half_width_at(lambda);
  const double share = 4.0 / 3.0 * (3.0 - 2.0 * nu) / (2.0 * M_PI * (1.0 - nu));
  EXPECT_NEAR(lambda / (a * a / R), 1.0 - share * a / d, 1e-6);
  EXPECT_NEAR(share, 0.74, 0.005);
}

TEST(BallContact, DeepInThePlasticRangeIsAsWideAsAPressedInBall) {
  const MidPlaneContact law = ball(cut_off(Nose::ball, 2.8), INFINITY);
  const double a = law.half_width_at(4e-4);
  EXPECT_NEAR(a * a / (2.0 * R * 4e-4), 1.0, 0.05);
  EXPECT_NEAR(law.plastic_force(4e-4) / (M_PI * a * a * 2.8 * Y), 1.0, 0.01);
}

TEST(MidPlaneContact, KeepsToTheRulesOfContactLaws) {
  for (const Variant& of : variants()) {
    for (const double depth : depths_of(of)) {
      const auto broken = broken_rule(of.law, depth);
      EXPECT_FALSE(broken) << of.name << ' ' << depth << ' ' << *broken;
    }
  }
}

TEST(MidPlaneContact, YieldsWithoutAJumpOfForceOrSlopeAndUnloadsWithoutAJumpOfForce) {
  for (const Variant& of : variants()) {
    const double first = of.law.yield_threshold({});
    if (std::isinf(first)) continue;
    SCOPED_TRACE(of.name);
    const double force = of.law.force({}, first), slope = of.law.slope({}, first);
    EXPECT_NEAR(of.law.plastic_force(first * (1.0 + 1e-12)), force, 1e-11 * force);
    EXPECT_NEAR(of.law.plastic_slope(first * (1.0 + 1e-12)), slope, 1e-5 * slope);
    double residual = 0.0;
    for (const double depth : depths_of(of)) {
      EXPECT_NEAR(of.law.force({depth}, depth), of.law.plastic_force(depth),
                  1e-13 * of.law.plastic_force(depth));
      EXPECT_GE(of.law.slope({depth}, depth), (1.0 - 1e-9) * of.law.plastic_slope(depth));
      EXPECT_EQ(of.law.force({depth}, of.law.residual_indentation({depth})), 0.0);
      EXPECT_GE(of.law.residual_indentation({depth}), residual);
      residual = of.law.residual_indentation({depth});
    }
  }
}

TEST(MidPlaneContact, IsNowhereSteeperThanItSays) {
  for (const Variant& of : variants()) {
    const double deepest = 1.2 * std::min(of.law.largest_indentation(), 5e-4);
    const double steepest = of.law.largest_slope(deepest) * (1.0 + 1e-5);
    for (double x = 0.01; x < 1.0; x += 0.01) {
      EXPECT_LE(of.law.slope({x * deepest}, x * deepest), steepest) << of.name << ' ' << x;
    }
  }
}

TEST(MidPlaneContact, HasTheSlopesOfItsForces) {
  for (const Variant& of : variants()) {
    for (const double depth : depths_of(of)) {
      const double residual = of.law.residual_indentation({depth});
      const auto expect_slope = [&](auto force, double slope, double x) {
        const double h = 1e-5 * (x - residual);
        EXPECT_NEAR((force(x + h) - force(x - h)) / (2.0 * h), slope, 1e-7 * slope)
            << of.name << ' ' << depth << ' ' << x;
      };
      for (const double part : {0.01, 0.3, 0.9}) {
        const double x = residual + part * (depth - residual);
        expect_slope([&](double at) { return of.law.force({depth}, at); }, of.law.slope({depth}, x),
                     x);
      }
      if (depth > 1.001 * of.law.yield_threshold({})) {
        expect_slope([&](double at) { return of.law.plastic_force(at); },
                     of.law.plastic_slope(depth), depth);
      }
    }
  }
}

// Work of a force between two indentations, by Simpson's rule in s, x = from + (to - from) s^4.
template <class Force>
double work(Force force, double from, double to) {
  constexpr int n = 4000;
  double sum = 0.0;
  for (int i = 0; i <= n; ++i) {
    const double s = static_cast<double>(i) / n, weight = i == 0 || i == n ? 1.0
                                                          : i % 2          ? 4.0
                                                                           : 2.0;
    sum += weight * 4.0 * s * s * s * force(from + (to - from) * s * s * s * s);
  }
  return (to - from) * sum / (3.0 * n);
}

TEST(MidPlaneContact, HasTheWorkOfItsForcesAsEnergies) {
  for (const Variant& of : variants()) {
    SCOPED_TRACE(of.name);
    const double first = std::min(of.law.yield_threshold({}), of.deepest);
    for (const double depth : depths_of(of)) {
      const double residual = of.law.residual_indentation({depth});
      const double returned =
          work([&](double x) { return of.law.force({depth}, x); }, residual, depth);
      EXPECT_NEAR(of.law.recoverable_energy({depth}, depth), returned, 1e-9 * returned) << depth;
      const double spent = work([&](double x) { return of.law.force({}, x); }, 0.0, first) +
                           work([&](double x) { return of.law.plastic_force(x); }, first, depth);
      EXPECT_NEAR(of.law.work_up_to(depth), spent, 1e-9 * spent) << depth;
    }
    EXPECT_EQ(of.law.dissipated_energy({0.99 * first}), 0.0);
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

// Laws keep the value that they computed last, by thread.
TEST(MidPlaneContact, AnswersAmongOthersAsItDoesAlone) {
  const std::vector<Variant> all = variants();
  const auto answers = [](const MidPlaneContact& law, double depth) {
    const ContactHistory deepest{depth};
    return std::array{law.plastic_force(depth), law.plastic_slope(depth),
                      law.force(deepest, 0.9 * depth), law.residual_indentation(deepest),
                      law.dissipated_energy(deepest)};
  };
  const std::vector<double> depths = {5e-5, 4e-5, 3e-5};
  std::vector<std::array<double, 5>> alone;
  for (const Variant& of : all) {
    for (const double depth : depths) alone.push_back(answers(of.law, depth));
  }
  for (std::size_t i = 0; i < depths.size(); ++i) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      EXPECT_EQ(answers(all[k].law, depths[i]), alone[k * depths.size() + i]) << all[k].name;
    }
  }
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

TEST(BallContact, ThatYieldsByDepthReturnsMoreThanAtItsFirstPressureAndLessThanAtItsLast) {
  const MidPlaneContact first = ball(cut_off(Nose::ball, 1.6)), rising = ball(by_depth(Nose::ball));
  const MidPlaneContact last = ball(cut_off(Nose::ball, 2.8));
  for (const double ratio : {3.0, 10.0, 100.0}) {
    const double energy = first.work_up_to(first.yield_threshold({})) * ratio * ratio;
    const auto returned = [&](const ContactLaw& law) {
      const double deepest = law.indentation_at(energy);
      return law.recoverable_energy({deepest}, deepest);
    };
    EXPECT_GT(returned(rising), returned(first)) << ratio;
    EXPECT_LT(returned(rising), returned(last)) << ratio;
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
