// The bending law by moments against the same law by curvatures.

#include "model/moment_law.h"

#include <random>

#include "paper_scene.h"
#include "testing.h"

namespace subimpact {
namespace {

class MomentLawOnRandomPaths : public testing::TestWithParam<unsigned> {};

INSTANTIATE_TEST_SUITE_P(Seeds, MomentLawOnRandomPaths, testing::Range(1u, 9u));

TEST_P(MomentLawOnRandomPaths, IsTheInverseOfTheLawByCurvatures) {
  const Beam beam = paper_beam();
  const SectionLaw by_curvature(beam, Fibres::continuous());
  const double unit = beam.yield_curvature();
  SectionHistory history;
  MomentLaw law;
  std::mt19937 random(GetParam());
  std::uniform_real_distribution<double> anywhere(-1.49, 1.49), nearby(-0.1, 0.1);
  double m = 0.0;
  for (int step = 0; step < 400; ++step) {
    const double by = nearby(random);
    m = step % 3 == 0 ? anywhere(random) : std::abs(m + by) < 1.49 ? m + by : m - by;
    const double x = m + law.at(m).plastic;
    EXPECT_NEAR(by_curvature.moment(history, x * unit) / beam.yield_moment(), m, 1e-10);
    const double slope = beam.bending_stiffness() / by_curvature.tangent(history, x * unit);
    EXPECT_NEAR(1.0 + law.at(m).slope, slope, 1e-6 * slope);
    by_curvature.commit(history, x * unit);
    law.commit(m, by_curvature, unit);
    EXPECT_NEAR(law.history(by_curvature, unit).work, history.work, 1e-9 * (1.0 + history.work));
  }
}

TEST_P(MomentLawOnRandomPaths, FlowsOnlyOutsideItsWindow) {
  const Beam beam = paper_beam();
  const SectionLaw by_curvature(beam, Fibres::continuous());
  MomentLaw law;
  std::mt19937 random(GetParam());
  std::uniform_real_distribution<double> anywhere(-1.49, 1.49);
  for (int step = 0; step < 100; ++step) {
    const double m = anywhere(random);
    const bool inside = m >= law.low() && m <= law.high();
    EXPECT_EQ(law.at(m).plastic == law.plastic(), inside);
    EXPECT_EQ(law.commit(m, by_curvature, beam.yield_curvature()), !inside);
  }
}

}  // namespace
}  // namespace subimpact
