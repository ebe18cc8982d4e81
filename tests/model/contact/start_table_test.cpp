#include "model/contact/curves.h"

#include <gtest/gtest.h>

#include <cmath>

namespace subimpact {
namespace {

// x^2 (5/4 - ln x), as a line contact has it.
ValueAndSlope curve(double x) {
  const double rest = 1.25 - std::log(x);
  return {x * x * rest, x * (2.0 * rest - 1.0)};
}

TEST(StartTables, SpareNewtonsMethodAllButTwoSteps) {
  const StartTable starts(curve, 1e-6, 0.5);
  for (double x = 1.1e-6; x < 0.49; x *= 1.0173) {
    const double value = curve(x).at;
    int n = 0;
    const auto counted = [&](double at) { return ++n, curve(at); };
    const double start = starts(value, NAN);
    EXPECT_NEAR(start / x, 1.0, 1e-6) << x;
    EXPECT_NEAR(inverse_of_power(counted, value, start) / x, 1.0, 4e-15) << x;
    EXPECT_LE(n, 2) << x;
  }
}

TEST(StartTables, HaveNoWordOutside) {
  const StartTable starts(curve, 1e-3, 0.1);
  EXPECT_EQ(starts(curve(0.9e-3).at, 7.0), 7.0);
  EXPECT_EQ(starts(curve(0.11).at, 7.0), 7.0);
  EXPECT_EQ(StartTable()(1.0, 7.0), 7.0);
  for (const double x : {0.9e-3, 0.11}) {  // where a guess has to do
    EXPECT_NEAR(inverse_of_power(curve, curve(x).at, std::sqrt(curve(x).at)) / x, 1.0, 4e-15);
  }
}

}  // namespace
}  // namespace subimpact
