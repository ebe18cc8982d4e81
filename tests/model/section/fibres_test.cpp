#include "subimpact/model/section/fibres.h"
#include "model/section/section_law.h"
#include "paper_scene.h"
#include "random_walk.h"
#include "testing.h"

namespace subimpact {
namespace {

// The moment of p layers summed one by one, in units of M_y.
double summed_moment(int layers, double x) {
  const int p = layers / 2;
  double sum = 0.0;
  for (int k = 1; k <= p; ++k) {
    const double zeta = (k - 0.5) / p;
    sum += std::clamp(zeta * x, -1.0, 1.0) * zeta / p;
  }
  return 3.0 * sum;
}

TEST(Fibres, ContinuousOnesHaveTheExactVirginCurve) {
  const Fibres fibres = Fibres::continuous();
  for (double x = 0.0; x <= 1.0; x += 0.0625) EXPECT_DOUBLE_EQ(fibres.response(x).moment, x);
  for (double x = 1.0; x < 40.0; x *= 1.1) {
    EXPECT_NEAR(fibres.response(x).moment, 1.5 - 0.5 / (x * x), 1e-15 * 4.0);
  }
  const struct {
    double x, m;
  } published[] = {{1.5, 1.277778}, {2.0, 1.375}, {3.0, 1.444444}, {5.0, 1.48}, {10.0, 1.495}};
  for (const auto& [x, m] : published) EXPECT_NEAR(fibres.response(x).moment, m, 0.5e-6);
}

TEST(Fibres, LayersAreTheSumOverLayers) {
  for (const int layers : {2, 4, 6, 10, 40, 160}) {
    const Fibres fibres = Fibres::layered(layers);
    for (double x = -30.0; x < 30.0; x += 0.0173) {
      ASSERT_NEAR(fibres.response(x).moment, summed_moment(layers, x), 1e-14)
          << layers << ", " << x;
    }
  }
}

TEST(Fibres, LayersYieldFirstWhereTheOutermostMidLayerDoes) {
  for (const int layers : {2, 4, 10, 40, 160}) {
    const Fibres fibres = Fibres::layered(layers);
    const double first = layers / (layers - 1.0);
    EXPECT_NEAR(fibres.first_yield(), first, 1e-15 * 4.0);
    EXPECT_NEAR(fibres.response(first).moment, fibres.slope() * first, 1e-14);
    const double zeta = 1.0 / first;
    EXPECT_DOUBLE_EQ(fibres.tangent(0.999 * first), fibres.slope());
    EXPECT_NEAR(fibres.tangent(1.001 * first), fibres.slope() - 6.0 * zeta * zeta / layers, 1e-14);
  }
  EXPECT_EQ(Fibres::continuous().first_yield(), 1.0);
}

// Tangent and moment as the derivatives of moment and work, by differences over 2 h.
void expect_derivatives(const Fibres& fibres, double x, double h) {
  EXPECT_NEAR((fibres.response(x + h).moment - fibres.response(x - h).moment) / (2.0 * h),
              fibres.tangent(x), 1e-8);
  EXPECT_NEAR((fibres.response(x + h).work - fibres.response(x - h).work) / (2.0 * h),
              fibres.response(x).moment, 1e-8);
}

TEST(Fibres, TangentAndMomentAreTheDerivativesOfMomentAndWork) {
  for (const Fibres& fibres : {Fibres::continuous(), Fibres::layered(40)}) {
    // Steps that avoid the kinks of the layers, at x = 40/(2k - 1).
    for (double x = -9.013; x < 9.0; x += 0.1171) expect_derivatives(fibres, x, 1e-6);
    EXPECT_EQ(fibres.response(0.0).work, 0.0);
    EXPECT_DOUBLE_EQ(fibres.response(-3.0).work, fibres.response(3.0).work);
  }
}

TEST(Fibres, EnergyIsTheIntegralOfTheSquaredStress) {
  const Fibres exact = Fibres::continuous();
  // 3/2 integral (1 - 2 z)^2 from 0.25 to 1 = 3/2 [ (2 z - 1)^3/6 ]
  EXPECT_NEAR(exact.energy(0.25, 1.0, 1.0, -2.0), 1.5 * (1.0 + 0.125) / 6.0, 1e-15);
  const Fibres layered = Fibres::layered(8);
  double sum = 0.0;
  for (const double zeta : {0.375, 0.625, 0.875}) sum += 0.25 * std::pow(1.0 - 2.0 * zeta, 2);
  EXPECT_NEAR(layered.energy(0.25, 1.0, 1.0, -2.0), 1.5 * sum, 1e-15);
}

TEST(Fibres, NeedAnEvenNumberOfLayers) {
  for (const int layers : {-2, 0, 1, 3, 41}) {
    EXPECT_THROW(Fibres::layered(layers), std::invalid_argument) << layers;
  }
  EXPECT_NO_THROW(Fibres::layered(2));
}

// Sections made of strips, against a sum over thousands of fibres with a memory each.

using Strips = std::vector<FibreStrip>;

const Strips sandwich{{.from = 0.0, .to = 0.8, .modulus = 0.1, .yield = 0.3},
                      {.from = 0.8, .to = 1.0, .width = 1.5}};
const Strips weak_core{{.from = 0.0, .to = 0.6, .modulus = 0.9, .yield = 0.2},
                       {.from = 0.6, .to = 1.0, .yield = 2.0}};
const Strips side_by_side{{.from = 0.0, .to = 1.0, .width = 0.5},
                          {.from = 0.2, .to = 0.9, .width = 0.5, .modulus = 2.0, .yield = 0.7}};

constexpr const char* names[] = {"Sandwich", "WeakCore", "SideBySide"};

/// Each strip as `n` fibres either side of the axis.
class FibreSum {
 public:
  FibreSum(const Beam& beam, const Strips& strips, int n) {
    for (const FibreStrip& strip : strips) {
      const double step = (strip.to - strip.from) / n;
      for (int i = 0; i < n; ++i) {
        const double z = 0.5 * beam.thickness * (strip.from + (i + 0.5) * step);
        fibres_.push_back({z, strip.modulus * beam.youngs_modulus, strip.yield * beam.yield_stress,
                           strip.width * beam.width * step * 0.5 * beam.thickness, 0.0});
      }
    }
  }
  /// M, N m; advances the history.
  double bend(double curvature) {
    double moment = 0.0;
    energy_ = 0.0;
    for (Fibre& f : fibres_) {
      const double trial = f.modulus * (f.z * curvature - f.plastic);
      const double stress = std::clamp(trial, -f.yield, f.yield);
      f.plastic += (trial - stress) / f.modulus;
      moment += 2.0 * f.z * stress * f.area;
      energy_ += stress * stress / f.modulus * f.area;
    }
    outer_ = -std::max_element(fibres_.begin(), fibres_.end(), [](const Fibre& a, const Fibre& b) {
                return a.z < b.z;
              })->stress_at(curvature);
    return moment;
  }
  double elastic_energy() const { return energy_; }  ///< J/m
  double outer_stress() const { return outer_; }     ///< Pa

 private:
  struct Fibre {
    double z, modulus, yield, area, plastic;
    double stress_at(double curvature) const { return modulus * (z * curvature - plastic); }
  };
  std::vector<Fibre> fibres_;
  double energy_ = 0.0, outer_ = 0.0;
};

class Strip : public testing::TestWithParam<Strips> {};

TEST_P(Strip, LawIsTheSumOverItsFibresOnRandomHistories) {
  const Beam beam = paper_beam();
  const SectionLaw law(beam, Fibres::strips(GetParam(), "strips"));
  const double unit = beam.yield_curvature();
  for (unsigned seed = 1; seed <= 4; ++seed) {
    FibreSum sum(beam, GetParam(), 2000);
    SectionHistory history;
    for (const double x : nested_walk(seed, 40, -6.0, 6.0, 6.0)) {
      const double curvature = x * unit;
      const double moment = sum.bend(curvature);
      EXPECT_NEAR(law.moment(history, curvature), moment, 2e-5 * beam.yield_moment());
      EXPECT_NEAR(law.elastic_energy(history, curvature), sum.elastic_energy(),
                  2e-4 * beam.yield_moment() * unit);
      EXPECT_NEAR(law.outer_stress(history, curvature), sum.outer_stress(),
                  2e-3 * beam.yield_stress);
      law.commit(history, curvature);
    }
  }
}

TEST_P(Strip, TangentAndMomentAreTheDerivativesOfMomentAndWork) {
  const Fibres fibres = Fibres::strips(GetParam(), "strips");
  for (const double x : {0.05, 0.3, 0.8, 1.7, 4.0, 20.0}) expect_derivatives(fibres, x, 1e-6 * x);
}

INSTANTIATE_TEST_SUITE_P(, Strip, testing::Values(sandwich, weak_core, side_by_side),
                         [](const auto& info) { return std::string(names[info.index]); });

TEST(FibreStrips, ThatFillTheRectangleAreTheContinuousSection) {
  const Fibres exact = Fibres::continuous();
  const Fibres strips = Fibres::strips({{0.0, 0.4}, {0.4, 0.7}, {0.7, 1.0}}, "rectangle");
  EXPECT_EQ(strips.first_yield(), 1.0);
  for (const double x : {0.5, 1.0, 1.5, 3.0, 30.0}) {
    EXPECT_NEAR(strips.response(x).moment, exact.response(x).moment, 1e-15 * 4.0);
    EXPECT_NEAR(strips.tangent(x), exact.tangent(x), 1e-15 * 4.0);
    EXPECT_NEAR(strips.response(x).work, exact.response(x).work, 1e-15 * 40.0);
  }
}

TEST(FibreStrips, RefuseWhatIsNoSection) {
  EXPECT_THROW(Fibres::strips({}, "none"), std::invalid_argument);
  EXPECT_THROW(Fibres::strips({{0.5, 0.5}}, "empty"), std::invalid_argument);
  EXPECT_THROW(Fibres::strips({{-0.1, 0.5}}, "beyond the axis"), std::invalid_argument);
  EXPECT_THROW(Fibres::strips({{0.5, 1.1}}, "beyond the beam"), std::invalid_argument);
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_THROW(Fibres::strips({{0.0, 1.0, bad}}, "width"), std::invalid_argument);
    EXPECT_THROW(Fibres::strips({{0.0, 1.0, 1.0, bad}}, "modulus"), std::invalid_argument);
    EXPECT_THROW(Fibres::strips({{0.0, 1.0, 1.0, 1.0, bad}}, "yield"), std::invalid_argument);
  }
}

}  // namespace
}  // namespace subimpact
