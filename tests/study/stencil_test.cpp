#include "study/stencil.h"

#include "testing.h"

namespace subimpact {
namespace {

// A number that changes as the root of the distance d from a graze, whose slope is -1/(2 d).
Stencil of_root(double d) {
  Stencil s;
  s.base = 1.0;
  for (std::size_t i = 0; i < sensitivity_shifts.size(); ++i) {
    s.plus[i] = std::sqrt(1.0 - sensitivity_shifts[i] / d);
    s.minus[i] = std::sqrt(1.0 + sensitivity_shifts[i] / d);
  }
  return s;
}

TEST(Stencil, ExtrapolatesWhereNumbersAreSmooth) {
  const double d = 1e-4;
  const Stencil s = of_root(d);
  const double exact = -0.5 / d;
  const Derivative smooth = derivative_of(s, 1e-16, Smoothness::everywhere);
  EXPECT_NEAR(smooth.value, exact, 1e-2 * std::abs(s.slope(1) - exact) + 1e-9 / d);
  EXPECT_GE(smooth.error, std::abs(smooth.value - exact));
  EXPECT_EQ(derivative_of(s, 1e-16, Smoothness::between_thresholds).value, s.slope(1));
}

TEST(Stencil, ShowsTheBendOfASlopeBeyondTheErrorsOfRuns) {
  EXPECT_GT(bend_of_slope(of_root(2e-5), 1e-16), 0.01 * 0.5 / 2e-5);
  EXPECT_EQ(bend_of_slope(of_root(2e-5), 1.0), 0.0);
}

}  // namespace
}  // namespace subimpact
