#include "integrate/central_difference.h"

#include "banded_examples.h"
#include "test_systems.h"

namespace subimpact {
namespace {

TEST(CentralDifference, IsTheThreePointFormulaOfThePaper) {
  CurvedMotion motion;
  const double step = 0.01;
  CentralDifference integrator(motion, step);
  integrator.restart(0.0, motion.initial());
  std::vector<State> states{motion.initial()};
  for (int i = 0; i < 200; ++i) {
    integrator.step();
    states.push_back(integrator.state());
  }
  std::vector<double> a(3);
  for (std::size_t k = 1; k + 1 < states.size(); ++k) {
    motion.acceleration({states[k].data(), 3}, a);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(states[k + 1][i] - 2.0 * states[k][i] + states[k - 1][i], step * step * a[i],
                  2e-15);
    }
  }
}

TEST(CentralDifference, AdvancesTheLastPositionByAConstantForceIfAsked) {
  CurvedMotion motion;
  const double step = 0.01;
  CentralDifference integrator(motion, step, true);
  integrator.restart(0.0, motion.initial());
  std::vector<double> a(3);
  motion.acceleration({motion.initial().data(), 3}, a);
  double q = motion.initial()[2];
  double u = motion.initial()[5] - 0.5 * step * a[2];
  State before, now = motion.initial();
  for (int i = 0; i < 200; ++i) {
    motion.acceleration({now.data(), 3}, a);
    integrator.step();
    const State next = integrator.state();
    q += step * u + 0.5 * step * step * a[2];
    u += step * a[2];
    EXPECT_NEAR(next[2], q, 2e-14);
    for (std::size_t k = 0; k < 2 && !before.empty(); ++k) {
      EXPECT_NEAR(next[k] - 2.0 * now[k] + before[k], step * step * a[k], 2e-15);
    }
    before = now;
    now = next;
  }
}

double largest_over(SpringChain& chain, double step, int n_steps) {
  CentralDifference integrator(chain, step);
  integrator.restart(0.0, chain.initial());
  double largest = 0.0;
  for (int i = 0; i < n_steps; ++i) {
    integrator.step();
    largest = std::max(largest, largest_of(integrator.state()));
  }
  return largest;
}

TEST(CentralDifference, IsStableJustBelowTheCriticalStepAndGrowsJustAbove) {
  for (const double rate : {1.0, 1e6}) {
    SpringChain chain(9, rate);
    const double critical = 2.0 / chain.frequency(9);
    // Below, the highest mode is overstated by up to 1/sqrt(1 - 0.999^2) = 22, for ever.
    EXPECT_LT(largest_over(chain, 0.999 * critical, 100000), 30.0 * rate);
    EXPECT_GT(largest_over(chain, 1.001 * critical, 1000), 1e20 * rate);
  }
}

TEST(CentralDifference, CountsItsTimeWithoutDrift) {
  SpringChain chain(1);
  CentralDifference integrator(chain, 1e-7);
  integrator.restart(0.25, chain.initial());
  for (int i = 0; i < 100000; ++i) integrator.step();
  EXPECT_EQ(integrator.time(), 0.25 + 100000 * 1e-7);
}

}  // namespace
}  // namespace subimpact
