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

TEST(SectionLaw, NeedsAFinitePositiveYieldStress) {
  for (const double stress : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()}) {
    Beam other = beam;
    other.yield_stress = stress;
    EXPECT_THROW(SectionLaw(other, Fibres::continuous()), std::invalid_argument) << stress;
  }
}

// --- closed forms against stacks of layers ---

/// A section as a stack of layers, each with the plain return map
/// sigma = clip(sigma_old + E d_eps, -Y, Y): what the section law's closed forms must add up to.
/// Stresses are those of the half in which a positive curvature pulls.
class LayeredSection {
 public:
  LayeredSection(const Beam& beam, int layers)
      : beam_(beam), layer_thickness_(beam.thickness / layers), stress_(half(layers), 0.0) {}

  void bend_to(double curvature) {
    const double change = curvature - curvature_;
    curvature_ = curvature;
    for (std::size_t k = 0; k < stress_.size(); ++k) {
      const double strain_change = change * height(k);
      const double trial = stress_[k] + beam_.youngs_modulus * strain_change;
      const double next = std::clamp(trial, -beam_.yield_stress, beam_.yield_stress);
      const double flow = (trial - next) / beam_.youngs_modulus;
      plastic_work_ += next * flow * area();
      stress_[k] = next;
    }
  }

  double moment() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < stress_.size(); ++k) sum += stress_[k] * height(k) * area();
    return sum;
  }
  double elastic_energy() const {
    double sum = 0.0;
    for (const double s : stress_) sum += 0.5 * s * s / beam_.youngs_modulus * area();
    return sum;
  }
  double plastic_work() const { return plastic_work_; }
  /// Of the outermost layer on the side away from the striker, where a positive curvature
  /// compresses.
  double outer_stress() const { return -stress_.back(); }

 private:
  static std::size_t half(int layers) { return static_cast<std::size_t>(layers / 2); }
  double height(std::size_t k) const { return (static_cast<double>(k) + 0.5) * layer_thickness_; }
  double area() const { return 2.0 * beam_.width * layer_thickness_; }  // of a pair of layers

  Beam beam_;
  double layer_thickness_;
  std::vector<double> stress_;
  double curvature_ = 0.0, plastic_work_ = 0.0;
};

struct Differences {
  double moment = 0.0;   // in M_y
  double elastic = 0.0;  // in M_y kappa_y
  double plastic = 0.0;  // in M_y kappa_y
  double stress = 0.0;   // in Y
  double plastic_total = 0.0;
};

// Largest differences over a walk in units of the yield curvature, each state looked at before and
// after it is committed.
Differences compare(const Fibres& fibres, int layers, const std::vector<double>& walk) {
  const Beam beam = paper_beam();
  const SectionLaw law(beam, fibres);
  LayeredSection stack(beam, layers);
  SectionHistory history;
  Differences largest;
  const double moment_unit = beam.yield_moment();
  const double energy_unit = moment_unit * beam.yield_curvature();
  const auto look = [&](double curvature) {
    const double elastic = law.elastic_energy(history, curvature);
    const double plastic = law.work(history, curvature) - elastic;
    const auto keep = [](double& most, double difference) {
      most = std::max(most, std::abs(difference));
    };
    keep(largest.moment, (law.moment(history, curvature) - stack.moment()) / moment_unit);
    keep(largest.elastic, (elastic - stack.elastic_energy()) / energy_unit);
    keep(largest.plastic, (plastic - stack.plastic_work()) / energy_unit);
    keep(largest.stress,
         (law.outer_stress(history, curvature) - stack.outer_stress()) / beam.yield_stress);
  };
  for (const double x : walk) {
    const double curvature = x * beam.yield_curvature();
    stack.bend_to(curvature);
    look(curvature);
    law.commit(history, curvature);
    look(curvature);
  }
  largest.plastic_total = stack.plastic_work() / energy_unit;
  return largest;
}

TEST(SectionLaw, OfLayersIsTheReturnMapOfEveryLayer) {
  const auto expect_rounding = [](int layers, const std::vector<double>& walk) {
    const Differences found = compare(Fibres::layered(layers), layers, walk);
    EXPECT_LE(found.moment, 1e-12);
    EXPECT_LE(found.elastic, 1e-12);
    // A sum over all steps.
    EXPECT_LE(found.plastic, 1e-13 * std::max(1.0, found.plastic_total));
    EXPECT_LE(found.stress, 1e-12);
  };
  for (const int layers : {2, 4, 10, 40}) {
    for (unsigned seed = 0; seed < 25; ++seed) {
      SCOPED_TRACE(testing::Message() << layers << " layers, seed " << seed);
      expect_rounding(layers, nested_walk(seed, 3000, -8.0, 8.0, 6.0));
    }
  }
  for (unsigned seed = 0; seed < 10; ++seed) {  // small loops about a large curvature
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::vector<double> walk{9.0};
    for (const double x : nested_walk(seed, 3000, 3.0, 8.9, 3.0)) walk.push_back(x);
    walk.push_back(-20.0);
    for (const double x : nested_walk(seed + 100, 3000, -19.0, 19.0, 30.0)) walk.push_back(x);
    expect_rounding(40, walk);
  }
  std::vector<double> spirals;
  for (const double growth : {0.93, 1.07}) {
    for (int i = 0; i < 40; ++i)
      spirals.push_back((i % 2 == 0 ? 10.0 : -10.0) * std::pow(growth, i));
  }
  expect_rounding(40, spirals);
  // Reversal points that are met exactly.
  expect_rounding(40, {3.0, -3.0, 3.0, -3.0, 2.0, -1.0, 2.0, -1.0, 2.0, -3.0, 3.0, -5.0, 5.0, 0.0,
                       5.0, 0.0, -5.0, 0.0});
}

}  // namespace
}  // namespace subimpact
