#include "model/section/section_law.h"

#include "paper_scene.h"
#include "random_walk.h"
#include "testing.h"

namespace subimpact {
namespace {

const Beam beam = paper_beam();
const double unit = beam.yield_curvature();
const double energy_unit = beam.yield_moment() * beam.yield_curvature();

SectionLaw exact_law() { return {beam, Fibres::continuous()}; }
SectionLaw layered_law() { return {beam, Fibres::layered(40)}; }

SectionHistory after(const SectionLaw& law, std::initializer_list<double> walk) {
  SectionHistory history;
  for (const double x : walk) law.commit(history, x * unit);
  return history;
}

bool same(const SectionHistory& a, const SectionHistory& b) {
  const auto same_point = [](SectionHistory::Point p, SectionHistory::Point q) {
    return p.x == q.x && p.m == q.m;
  };
  return a.direction == b.direction && a.work == b.work && same_point(a.edge, b.edge) &&
         std::equal(a.reversals.begin(), a.reversals.end(), b.reversals.begin(), b.reversals.end(),
                    same_point);
}

TEST(SectionLaw, HasTheNumbersOfThePapersExample) {
  EXPECT_NEAR(unit, 0.555864, 0.5e-6);
  EXPECT_DOUBLE_EQ(exact_law().stiffness(), beam.bending_stiffness());
  EXPECT_NEAR(layered_law().stiffness(), (1.0 - 1.0 / 1600.0) * beam.bending_stiffness(), 1e-12);
}

TEST(SectionLaw, FollowsTheVirginCurveAtFirstLoading) {
  const struct {
    double x, exact, layers;
  } published[] = {{1.5, 1.277778, 1.2775781},
                   {2.0, 1.375, 1.374375},
                   {3.0, 1.444444, 1.4442187},
                   {5.0, 1.48, 1.479375},
                   {10.0, 1.495, 1.494375}};
  for (const auto& [x, exact, layers] : published) {
    for (const double side : {1.0, -1.0}) {
      const double curvature = side * x * unit;
      EXPECT_NEAR(exact_law().moment({}, curvature) / beam.yield_moment(), side * exact, 0.6e-6);
      EXPECT_NEAR(layered_law().moment({}, curvature) / beam.yield_moment(), side * layers, 0.6e-7);
    }
  }
}

TEST(SectionLaw, UnloadedKeepsTheResidualCurvatureOfItsMoment) {
  const SectionLaw law = exact_law();
  for (const double x : {1.2, 2.0, 5.0, 10.0}) {
    const SectionHistory history = after(law, {x});
    const double residual = x - (1.5 - 0.5 / (x * x));
    EXPECT_NEAR(law.moment(history, residual * unit), 0.0, 1e-13 * beam.yield_moment());
    EXPECT_GT(law.moment(history, (residual + 0.01) * unit), 0.0099 * beam.yield_moment());
  }
}

TEST(SectionLaw, SpendsTheAreaOfTheHysteresisLoopInEveryCycle) {
  const SectionLaw law = exact_law();
  for (const double x : {1.1, 1.5, 3.0, 8.0}) {
    SectionHistory history = after(law, {x, -x, x});
    const double area = 6.0 * energy_unit * std::pow(x - 1.0, 2) / x;
    double drawn = 0.0;  // the loop's area from the moments alone, by Simpson's rule
    for (int cycle = 0; cycle < 3; ++cycle) {
      const double before = law.work(history, x * unit);
      for (const double end : {-x, x}) {
        const int n = 4000;
        const double h = (end - (-end)) / n;
        for (int i = 0; i < n; ++i) {
          const double a = -end + i * h;
          drawn +=
              h * unit / 6.0 *
              (law.moment(history, a * unit) + 4.0 * law.moment(history, (a + 0.5 * h) * unit) +
               law.moment(history, (a + h) * unit));
        }
        law.commit(history, end * unit);
      }
      EXPECT_NEAR(law.work(history, x * unit) - before, area, 1e-12 * energy_unit * x * x);
    }
    EXPECT_NEAR(drawn, 3.0 * area, 1e-6 * energy_unit) << "x = " << x;
  }
}

TEST(SectionLaw, ForgetsClosedLoops) {
  for (const SectionLaw& law : {exact_law(), layered_law()}) {
    // Loops that close exactly, and loops that pass a little beyond.
    for (const double growth : {0.0, 1e-6}) {
      SectionHistory history;
      for (int cycle = 0; cycle < 1000; ++cycle) {
        for (const double x : {4.0, -1.0, 2.0, -4.0}) {
          law.commit(history, x * (1.0 + growth * cycle) * unit);
          ASSERT_LE(history.reversals.size(), 3u) << "cycle " << cycle;
        }
      }
    }
    SectionHistory history = after(law, {4.0, -4.0});
    for (const double x : {5.0, -3.0, 3.0, -2.5, 2.5}) law.commit(history, x * unit);
    EXPECT_GE(history.reversals.size(), 4u);
    // Beyond everything so far the virgin curve is regained and nothing else is remembered.
    law.commit(history, 6.0 * unit);
    EXPECT_TRUE(history.reversals.empty());
    EXPECT_NEAR(law.moment(history, 7.0 * unit), law.moment({}, 7.0 * unit),
                1e-13 * beam.yield_moment());
  }
}

TEST(SectionLaw, RemembersReversalsThatAlternateAndCloseIn) {
  for (const SectionLaw& law : {exact_law(), layered_law()}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      SectionHistory history;
      for (const double x : nested_walk(seed, 2000, -20.0, 20.0, 15.0)) {
        law.commit(history, x * unit);
        for (std::size_t i = 2; i < history.reversals.size(); ++i) {
          const double last = history.reversals[i].x - history.reversals[i - 1].x;
          const double before = history.reversals[i - 1].x - history.reversals[i - 2].x;
          ASSERT_LT(last * before, 0.0);
          ASSERT_LT(std::abs(last), std::abs(before));
        }
      }
    }
  }
}

TEST(SectionLaw, InsideItsWindowNothingChangesAndTheMomentIsLinear) {
  for (const SectionLaw& law : {exact_law(), layered_law()}) {
    SectionHistory history;
    for (const double x : nested_walk(3, 2000, -8.0, 8.0, 6.0)) {
      const ElasticWindow window = law.window(history);
      ASSERT_LT(window.low, window.high);
      const double margin = 1e-12 * unit;
      for (const double part : {0.0, 0.3, 0.9, 1.0}) {
        double curvature = window.low + part * (window.high - window.low);
        curvature = std::clamp(curvature, window.low + margin, window.high - margin);
        SectionHistory visited = history;
        law.commit(visited, curvature);
        ASSERT_TRUE(same(visited, history));
        ASSERT_NEAR(law.moment(history, curvature), law.stiffness() * curvature - window.offset,
                    1e-13 * beam.yield_moment());
        ASSERT_EQ(law.tangent(history, curvature), law.stiffness());
      }
      for (const double beyond : {window.low - 1e-9 * unit, window.high + 1e-9 * unit}) {
        SectionHistory visited = history;
        law.commit(visited, beyond);
        ASSERT_FALSE(same(visited, history));
      }
      law.commit(history, x * unit);
    }
  }
}

TEST(SectionLaw, WindowIsTwiceFirstYieldWide) {
  for (const SectionLaw& law : {exact_law(), layered_law()}) {
    const ElasticWindow first = law.window({});
    EXPECT_EQ(first.low, -first.high);
    EXPECT_EQ(first.offset, 0.0);
    const ElasticWindow later = law.window(after(law, {4.0}));
    EXPECT_DOUBLE_EQ(later.high, 4.0 * unit);
    EXPECT_NEAR(later.high - later.low, 2.0 * first.high, 1e-14);
  }
  EXPECT_NEAR(layered_law().window({}).high, 40.0 / 39.0 * unit, 1e-14);
}

TEST(SectionLaw, MomentIsContinuousAcrossTheWindowsEdges) {
  for (const SectionLaw& law : {exact_law(), layered_law()}) {
    SectionHistory history;
    for (const double x : nested_walk(9, 1000, -8.0, 8.0, 6.0)) {
      law.commit(history, x * unit);
      const ElasticWindow window = law.window(history);
      for (const double edge : {window.low, window.high}) {
        const double h = 1e-9 * unit;
        ASSERT_NEAR(law.moment(history, edge - h), law.moment(history, edge + h),
                    2.01 * h * law.stiffness());
      }
    }
  }
}

TEST(SectionLaw, TangentEqualsFiniteDifferencesOfTheMoment) {
  for (const SectionLaw& law : {exact_law(), layered_law()}) {
    SectionHistory history;
    int n_compared = 0, n_kinks = 0;
    const double h = 1e-6 * unit;
    const std::vector<double> trials = random_numbers(8, 3000, 10.0 * unit);
    const std::vector<double> walk = nested_walk(4, trials.size(), -8.0, 8.0, 6.0);
    for (std::size_t i = 0; i < walk.size(); ++i) {
      law.commit(history, walk[i] * unit);
      const double tangent = law.tangent(history, trials[i]);
      EXPECT_GE(tangent, 0.0);
      EXPECT_LE(tangent, law.stiffness());
      const double before = law.tangent(history, trials[i] - h);
      const double behind = law.tangent(history, trials[i] + h);
      if (std::abs(before - behind) > 1e-3 * law.stiffness()) {
        ++n_kinks;  // a layer yields, or a loop closes, in between
        continue;
      }
      ++n_compared;
      const double difference =
          (law.moment(history, trials[i] + h) - law.moment(history, trials[i] - h)) / (2.0 * h);
      ASSERT_NEAR(tangent, difference, 1e-6 * law.stiffness());
    }
    EXPECT_GT(n_compared, 2900);
    EXPECT_LT(n_kinks, 10);
  }
}

TEST(SectionLaw, WorkIsTheIntegralOfTheMoment) {
  for (const SectionLaw& law : {exact_law(), layered_law()}) {
    SectionHistory history;
    double at = 0.0, sum = 0.0;
    for (const double next : nested_walk(12, 300, -6.0, 6.0, 5.0)) {
      const int n = 4000;
      const double h = (next - at) * unit / n;
      for (int i = 0; i < n; ++i) sum += h * law.moment(history, at * unit + (i + 0.5) * h);
      at = next;
      ASSERT_NEAR(law.work(history, at * unit), sum, 1e-5 * energy_unit);
      law.commit(history, at * unit);
      ASSERT_NEAR(law.work(history, at * unit), sum, 1e-5 * energy_unit);
    }
  }
}

TEST(SectionLaw, PlasticWorkNeverDecreases) {
  for (const SectionLaw& law : {exact_law(), layered_law()}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      SectionHistory history;
      double before = 0.0;
      for (const double x : nested_walk(seed, 2000, -8.0, 8.0, 6.0)) {
        const double curvature = x * unit;
        const double plastic =
            law.work(history, curvature) - law.elastic_energy(history, curvature);
        ASSERT_GE(plastic, before - 1e-13 * std::max(before, energy_unit)) << "seed " << seed;
        before = plastic;
        law.commit(history, curvature);
      }
      EXPECT_GT(before, energy_unit);
    }
  }
}

TEST(SectionLaw, OuterFibreAwayFromTheStrikerIsCompressedByPositiveCurvature) {
  const SectionLaw law = exact_law();
  const double reach = 0.5 * beam.youngs_modulus * beam.thickness;
  EXPECT_NEAR(law.outer_stress({}, 0.5 * unit), -reach * 0.5 * unit, 1e-9 * beam.yield_stress);
  EXPECT_NEAR(law.outer_stress({}, 3.0 * unit), -beam.yield_stress, 1e-9 * beam.yield_stress);
  EXPECT_NEAR(law.outer_stress({}, -3.0 * unit), beam.yield_stress, 1e-9 * beam.yield_stress);
  // Unloading by kappa_y takes the outer fibre back by Y.
  const SectionHistory history = after(law, {3.0});
  EXPECT_NEAR(law.outer_stress(history, 2.0 * unit), 0.0, 1e-9 * beam.yield_stress);
  EXPECT_NEAR(law.outer_stress(history, 1.0 * unit), beam.yield_stress, 1e-9 * beam.yield_stress);
}

TEST(SectionLaw, NeedsAFinitePositiveYieldStress) {
  for (const double stress : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()}) {
    Beam other = beam;
    other.yield_stress = stress;
    EXPECT_THROW(SectionLaw(other, Fibres::continuous()), std::invalid_argument) << stress;
  }
}

}  // namespace
}  // namespace subimpact
