#include "numerics/mass_solver.h"

#include <Eigen/Cholesky>

#include "banded_examples.h"
#include "testing.h"

namespace subimpact {
namespace {

constexpr double rounding = 1e-14;

TEST(BandedMatrix, MultipliesAsTheFullMatrix) {
  for (const std::size_t bandwidth : {0u, 1u, 2u, 3u}) {
    for (const std::size_t n : {1u, 2u, 5u, 30u}) {
      const BandedMatrix matrix = random_positive_definite(n, bandwidth, 3);
      const Eigen::MatrixXd full = dense(matrix);
      EXPECT_EQ(full, full.transpose());
      const std::vector<double> x = random_numbers(4, n);
      const Eigen::Map<const Eigen::VectorXd> vector(x.data(), index(n));
      std::vector<double> product(n);
      matrix.multiply(x, product);
      const Eigen::VectorXd expected = full * vector;
      for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(product[i], expected(index(i)), 1e-14);
      EXPECT_NEAR(matrix.quadratic_form(x), vector.dot(expected), 1e-13);
    }
  }
}

TEST(BandedSolver, AgreesWithDenseFactorisationForEverySizeUpToSixty) {
  for (const std::size_t bandwidth : {0u, 1u, 2u, 3u}) {
    for (std::size_t n = 1; n <= 60; ++n) {
      const BandedMatrix matrix =
          random_positive_definite(n, bandwidth, static_cast<unsigned>(100 * bandwidth + n));
      const BandedSolver solver(matrix);
      std::vector<double> x = random_numbers(7, n);
      const Eigen::VectorXd solution =
          dense(matrix).ldlt().solve(Eigen::Map<const Eigen::VectorXd>(x.data(), index(n)));
      const std::vector<double> expected(solution.begin(), solution.end());
      solver.solve(x);
      EXPECT_LE(relative_difference(x, expected), rounding) << n << " of bandwidth " << bandwidth;
    }
  }
}

TEST(BandedSolver, ReachesNothingBeyondItsUnknowns) {
  for (const std::size_t n : {3u, 8u, 13u, 16u}) {
    const BandedSolver solver(random_positive_definite(n, 2, 6));
    std::vector<double> x(n + 16, 42.0);
    solver.solve(std::span<double>(x).subspan(8, n));
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(x[i], 42.0);
    for (std::size_t i = n + 8; i < x.size(); ++i) EXPECT_EQ(x[i], 42.0);
  }
}

TEST(BandedMatrix, IsTheProductOfItsCholeskyFactorAndItsTranspose) {
  for (const std::size_t bandwidth : {0u, 1u, 3u, 6u}) {
    for (const std::size_t n : {1u, 2u, 9u, 40u}) {
      const BandedMatrix matrix = random_positive_definite(n, bandwidth, 11);
      const auto factor = matrix.cholesky_factor();
      ASSERT_TRUE(factor);
      EXPECT_EQ(factor->half_bandwidth(), bandwidth);
      const Eigen::MatrixXd lower = dense(*factor).triangularView<Eigen::Lower>();
      EXPECT_LE((lower * lower.transpose() - dense(matrix)).cwiseAbs().maxCoeff(), rounding);
    }
  }
}

// A chain of springs free at both ends, its zero eigenvalue shifted.
BandedMatrix free_chain(std::size_t n, double lowest) {
  BandedMatrix chain(n, 1);
  for (std::size_t i = 0; i < n; ++i) chain.at(i, i) = (i == 0 || i + 1 == n ? 1.0 : 2.0) + lowest;
  for (std::size_t i = 0; i + 1 < n; ++i) chain.at(i, i + 1) = -1.0;
  return chain;
}

TEST(BandedMatrix, HasNoCholeskyFactorWithANegativeEigenvalueHoweverSmall) {
  EXPECT_TRUE(free_chain(30, 1e-12).cholesky_factor().has_value());
  EXPECT_FALSE(free_chain(30, -1e-12).cholesky_factor().has_value());
}

TEST(BandedSolver, RefusesAMatrixThatIsNotPositiveDefinite) {
  for (const std::size_t row : {0u, 4u, 8u, 19u}) {
    BandedMatrix negative = random_positive_definite(20, 1, 2);
    negative.at(row, row) = -1.0;
    EXPECT_THROW(BandedSolver{negative}, std::invalid_argument) << row;
  }
  EXPECT_THROW(BandedSolver{free_chain(10, 0.0)}, std::invalid_argument);
}

}  // namespace
}  // namespace subimpact
