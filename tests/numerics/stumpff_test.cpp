#include "numerics/sin_cos.h"

#include "testing.h"

namespace subimpact {
namespace {

// Next to others on which the formulae differ.
std::array<double, 6> stumpff_of(double y) {
  Lanes values{0.5, 0.0, 1e3, 0.999, 1.5, 7e6, 1e-9, 1.0};
  values[2] = y;
  const StumpffLanes c = stumpff(values);
  std::array<double, 6> result{};
  for (std::size_t k = 0; k < 6; ++k) result[k] = c[k][2];
  return result;
}

TEST(StumpffFunctions, AreTheirSeriesAndTheirIntegrals) {
  for (const double y : {0.0, 1e-8, 1e-3, 0.3, 0.999, 1.0, 1.001, 2.5, 10.0, 300.0}) {
    const auto c = stumpff_of(y);
    // C_{k+2} is the k-fold repeated integral; here by Simpson's rule on
    // m! C_{m+2}(y) = integral_0^1 sin(y (1 - s))/y s^m ds.
    constexpr int n = 20000;
    for (int m = 0; m <= 3; ++m) {
      double sum = 0.0;
      for (int i = 0; i <= n; ++i) {
        const double s = static_cast<double>(i) / n;
        const double x = y * (1.0 - s);
        const double kernel = y > 0.0 ? std::sin(x) / y : 1.0 - s;
        sum += (i == 0 || i == n ? 1.0 : i % 2 ? 4.0 : 2.0) * kernel * std::pow(s, m);
      }
      const double factorial = m == 3 ? 6.0 : m == 2 ? 2.0 : 1.0;
      const double expected = sum / (3.0 * n) / factorial;
      EXPECT_NEAR(c[static_cast<std::size_t>(m + 2)], expected, 1e-13) << "y " << y << " m " << m;
    }
    EXPECT_NEAR(c[0], std::cos(y), 1e-15);
    EXPECT_NEAR(c[1], y > 0.0 ? std::sin(y) / y : 1.0, 1e-15);
  }
}

TEST(StumpffFunctions, AreContinuousWhereTheFormulaChanges) {
  const auto below = stumpff_of(std::nextafter(1.0, 0.0));
  const auto above = stumpff_of(1.0);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(below[k], above[k], 4e-15) << k;
}

}  // namespace
}  // namespace subimpact
