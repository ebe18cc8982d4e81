#include "numerics/richardson.h"

#include "testing.h"

namespace subimpact {
namespace {

TEST(Richardson, FindsTheLimitOfAnExactPowerLaw) {
  for (const double order : {1.0, 2.0, 3.5, 4.0}) {
    for (const double ratio : {1.5, 2.0, 10.0}) {
      const auto v = [&](double h) { return 3.0 - 0.7 * std::pow(h, order); };
      SCOPED_TRACE(testing::Message() << "order " << order << ", ratio " << ratio);
      const double h = 0.1;
      EXPECT_NEAR(richardson_limit(v(h), v(h / ratio), ratio, order), 3.0, 4e-15);
    }
  }
}

TEST(Richardson, DifferencesOfUnequalRatiosShowTheOrder) {
  const auto v = [](double h) { return 1.0 + h * h; };
  const double found = (v(0.5) - v(0.2)) / (v(0.2) - v(0.1));
  EXPECT_NEAR(ratio_of_differences(0.5, 0.2, 0.1, 2.0), found, 1e-13);
  EXPECT_NEAR(ratio_of_differences(4.0, 2.0, 1.0, 3.0), 8.0, 1e-14);
}

TEST(Richardson, TakesTheTrapezoidalRuleToSimpsons) {
  // integral of x^3 over [0, 1] by one and by two panels: the limit is Simpson's rule, exact here.
  EXPECT_NEAR(richardson_limit(0.5, 0.5 * (0.5 * (0.0 + 1.0) + 0.125), 2.0, 2.0), 0.25, 1e-16);
}

}  // namespace
}  // namespace subimpact
