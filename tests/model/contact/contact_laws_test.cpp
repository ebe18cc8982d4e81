// What holds for every contact law and variant, whether it yields or not.

#include "contact/noses_on_a_beam.h"
#include "model/contact/curve_contact.h"
#include "model/contact/power_contact.h"
#include "testing.h"

namespace subimpact {
namespace {

struct Variant {
  const char* name;
  std::shared_ptr<const ContactLaw> law;
  double deepest;          // m, to which it is looked at
  double rounding = 1e-9;  // relative, of its quadratures
};

std::vector<Variant> variants() {
  std::vector<Variant> all;
  const auto add = [&]<class Law>(const char* name, const Law& law, double deepest,
                                  double rounding = 1e-9) {
    all.push_back({name, std::make_shared<Law>(law), deepest, rounding});
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
      MidPlaneContact("sphere", ball_on_beam({R, INFINITY, E, nu, both(rigid), 0.9}),
                      by_depth(Nose::ball)),
      4e-4);
  add("Thornton's sphere", SphereContact(0.012, 9e10, 4e8), 1e-4);
  for (const double exponent : {1.0, 1.5, 2.5}) {
    add("power", PowerContact(1e9, exponent, rigid), 1e-4);
    if (exponent > 1.0) add("power that yields", PowerContact(1e9, exponent, 1e-5), 1e-4);
    MeasuredCurve loading;
    for (int i = 1; i <= 12; ++i) {
      loading.indentations.push_back(1e-4 * i / 12.0);
      loading.forces.push_back(1e9 * std::pow(1e-4 * i / 12.0, exponent));
    }
    add("curve", CurveContact(loading, {}), 1e-4, 1e-4);
    const double force = loading.forces.back();
    const MeasuredCurve back{{0.5e-4, 0.75e-4, 1e-4}, {0.0, 0.5 * force, force}};
    if (exponent < 2.0) add("curve with unloading", CurveContact(loading, back), 1e-4, 1e-4);
  }
  return all;
}

// Depths from that of first yield on, and where nothing yields.
std::vector<double> depths_of(const Variant& of) {
  const double first = std::min(of.law->yield_threshold({}), of.deepest);
  std::vector<double> depths;
  for (const double part : {0.0, 0.01, 0.1, 0.5, 1.0}) {
    if (first + part > 0.0) depths.push_back(first + part * (of.deepest - first));
  }
  return depths;
}

TEST(ContactLaws, KeepsToTheRulesOfContactLaws) {
  for (const Variant& of : variants()) {
    for (const double depth : depths_of(of)) {
      const auto broken = broken_rule(*of.law, depth);
      EXPECT_FALSE(broken) << of.name << ' ' << depth << ' ' << *broken;
    }
  }
}

TEST(ContactLaws, YieldsWithoutAJumpOfForceOrSlopeAndUnloadsWithoutAJumpOfForce) {
  for (const Variant& of : variants()) {
    const double first = of.law->yield_threshold({});
    if (std::isinf(first) || first == 0.0) continue;
    SCOPED_TRACE(of.name);
    const double force = of.law->force({}, first), slope = of.law->slope({}, first);
    EXPECT_NEAR(of.law->plastic_force(first * (1.0 + 1e-12)), force, 1e-11 * force);
    EXPECT_NEAR(of.law->plastic_slope(first * (1.0 + 1e-12)), slope, 1e-5 * slope);
    double residual = 0.0;
    for (const double depth : depths_of(of)) {
      EXPECT_NEAR(of.law->force({depth}, depth), of.law->plastic_force(depth),
                  1e-13 * of.law->plastic_force(depth));
      EXPECT_GE(of.law->slope({depth}, depth), (1.0 - 1e-9) * of.law->plastic_slope(depth));
      EXPECT_NEAR(of.law->force({depth}, of.law->residual_indentation({depth})), 0.0,
                  1e-13 * of.law->plastic_force(depth));
      EXPECT_GE(of.law->residual_indentation({depth}), residual);
      residual = of.law->residual_indentation({depth});
    }
  }
}

TEST(ContactLaws, IsNowhereSteeperThanItSays) {
  for (const Variant& of : variants()) {
    const bool has_last_point = of.law->limit() == ContactLaw::Limit::last_point;
    const double beyond = has_last_point ? 1.0 : 1.2;  // as trial steps go
    const double deepest = beyond * std::min(of.law->largest_indentation(), 5e-4);
    const double steepest = of.law->largest_slope(deepest) * (1.0 + 1e-5);
    for (double x = 0.01; x < 1.0; x += 0.01) {
      EXPECT_LE(of.law->slope({x * deepest}, x * deepest), steepest) << of.name << ' ' << x;
    }
  }
}

TEST(ContactLaws, HasTheSlopesOfItsForces) {
  for (const Variant& of : variants()) {
    for (const double depth : depths_of(of)) {
      const double residual = of.law->residual_indentation({depth});
      const auto expect_slope = [&](auto force, double slope, double x) {
        const double h = 1e-5 * (x - residual);
        EXPECT_NEAR((force(x + h) - force(x - h)) / (2.0 * h), slope, 1e2 * of.rounding * slope)
            << of.name << ' ' << depth << ' ' << x;
      };
      for (const double part : {0.01, 0.3, 0.9}) {
        const double x = residual + part * (depth - residual);
        expect_slope([&](double at) { return of.law->force({depth}, at); },
                     of.law->slope({depth}, x), x);
      }
      if (depth > 1.001 * of.law->yield_threshold({})) {
        expect_slope([&](double at) { return of.law->plastic_force(at); },
                     of.law->plastic_slope(depth), depth);
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

TEST(ContactLaws, HasTheWorkOfItsForcesAsEnergies) {
  for (const Variant& of : variants()) {
    SCOPED_TRACE(of.name);
    const double first = std::min(of.law->yield_threshold({}), of.deepest);
    for (const double depth : depths_of(of)) {
      const double residual = of.law->residual_indentation({depth});
      const double returned =
          work([&](double x) { return of.law->force({depth}, x); }, residual, depth);
      EXPECT_NEAR(of.law->recoverable_energy({depth}, depth), returned, of.rounding * returned)
          << depth;
      double spent = work([&](double x) { return of.law->force({}, x); }, 0.0, first);
      if (depth > first) {
        spent += work([&](double x) { return of.law->plastic_force(x); }, first, depth);
      }
      EXPECT_NEAR(of.law->work_up_to(depth), spent, of.rounding * spent) << depth;
      EXPECT_NEAR(of.law->indentation_at(of.law->work_up_to(depth)), depth, 1e-8 * depth);
    }
    EXPECT_EQ(of.law->dissipated_energy({0.99 * first}), 0.0);
  }
}

// Laws keep the value that they computed last, by thread.
TEST(ContactLaws, AnswersAmongOthersAsItDoesAlone) {
  const std::vector<Variant> all = variants();
  const auto answers = [](const ContactLaw& law, double depth) {
    const ContactHistory deepest{depth};
    return std::array{law.plastic_force(depth), law.plastic_slope(depth),
                      law.force(deepest, 0.9 * depth), law.residual_indentation(deepest),
                      law.dissipated_energy(deepest)};
  };
  const std::vector<double> depths = {5e-5, 4e-5, 3e-5};
  std::vector<std::array<double, 5>> alone;
  for (const Variant& of : all) {
    for (const double depth : depths) alone.push_back(answers(*of.law, depth));
  }
  for (std::size_t i = 0; i < depths.size(); ++i) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      EXPECT_EQ(answers(*all[k].law, depths[i]), alone[k * depths.size() + i]) << all[k].name;
    }
  }
}

}  // namespace
}  // namespace subimpact
