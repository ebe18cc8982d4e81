// Sections made of strips, against a sum over thousands of fibres with a memory each.

#include "model/section_law.h"
#include "paper_scene.h"
#include "random_walk.h"
#include "testing.h"

namespace subimpact {
namespace {

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
  for (const double x : {0.05, 0.3, 0.8, 1.7, 4.0, 20.0}) {
    const double h = 1e-6 * x;
    EXPECT_NEAR((fibres.moment(x + h) - fibres.moment(x - h)) / (2.0 * h), fibres.tangent(x), 1e-8);
    EXPECT_NEAR((fibres.work(x + h) - fibres.work(x - h)) / (2.0 * h), fibres.moment(x), 1e-8);
  }
}

INSTANTIATE_TEST_SUITE_P(, Strip, testing::Values(sandwich, weak_core, side_by_side),
                         [](const auto& info) { return std::string(names[info.index]); });

TEST(FibreStrips, ThatFillTheRectangleAreTheContinuousSection) {
  const Fibres exact = Fibres::continuous();
  const Fibres strips = Fibres::strips({{0.0, 0.4}, {0.4, 0.7}, {0.7, 1.0}}, "rectangle");
  EXPECT_EQ(strips.first_yield(), 1.0);
  for (const double x : {0.5, 1.0, 1.5, 3.0, 30.0}) {
    EXPECT_NEAR(strips.moment(x), exact.moment(x), 1e-15 * 4.0);
    EXPECT_NEAR(strips.tangent(x), exact.tangent(x), 1e-15 * 4.0);
    EXPECT_NEAR(strips.work(x), exact.work(x), 1e-15 * 40.0);
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
