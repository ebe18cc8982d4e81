#include "numerics/gauss.h"
#include "testing.h"

namespace subimpact {
namespace {

template <std::size_t n>
double integral_of_power(int k) {
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) sum += gauss<n>.weights[i] * std::pow(gauss<n>.points[i], k);
  return sum;
}

template <std::size_t n>
void expect_degree_and_error_constant() {
  SCOPED_TRACE(n);
  const int degree = 2 * static_cast<int>(n) - 1;
  for (int k = 0; k <= degree; ++k) {
    EXPECT_NEAR(integral_of_power<n>(k), 1.0 / (k + 1), 2.5e-16) << "power " << k;
  }
  // The error on s^2n is (n!)^4/((2n + 1) (2n)!^2).
  const double share = std::pow(std::tgamma(n + 1.0), 2) / std::tgamma(2.0 * n + 1.0);
  const double expected = share * share / (2.0 * n + 1.0);
  EXPECT_NEAR((1.0 / (degree + 2) - integral_of_power<n>(degree + 1)) / expected, 1.0, 1e-10);
}

TEST(GaussRule, IsExactUpToItsDegreeAndHasItsErrorConstantBeyond) {
  expect_degree_and_error_constant<2>();
  expect_degree_and_error_constant<3>();
  expect_degree_and_error_constant<4>();
  expect_degree_and_error_constant<5>();
}

}  // namespace
}  // namespace subimpact
