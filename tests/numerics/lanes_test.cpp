// Operations on eight numbers at once against the same one by one.

#include "numerics/lanes.h"
#include "numerics/sin_cos.h"
#include "subimpact/numerics/banded_matrix.h"
#include "testing.h"

namespace subimpact {
namespace {

TEST(SinesOfLanes, AreThoseOfTheStandardLibraryToTwoUnitsInTheLastPlace) {
  // Near multiples of a quarter turn, where digits cancel, in between, and beyond the reduction.
  std::vector<double> numbers{0.0, 1e-300, 1e-9, 0.5, 1e5, 999999.0, 1e6, 1.5e6, 1e12};
  for (const double turn : {1.0, 2.0, 3.0, 7.0, 100.0, 12345.0, 636619.0}) {
    for (const double off : {0.0, 1e-12, -1e-6, 0.3, 0.785, -0.786}) {
      numbers.push_back(turn * 1.5707963267948966 + off);
    }
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    for (const double sign : {1.0, -1.0}) {
      Lanes y{};
      for (std::size_t k = 0; k < n_lanes; ++k) y[k] = sign * numbers[(i + k) % numbers.size()];
      const SinCos found = sin_cos(y);
      for (std::size_t k = 0; k < n_lanes; ++k) {
        const double unit = 2.0 * std::numeric_limits<double>::epsilon();
        EXPECT_NEAR(found.sine[k], std::sin(y[k]), unit * std::abs(std::sin(y[k]))) << y[k];
        EXPECT_NEAR(found.cosine[k], std::cos(y[k]), unit * std::abs(std::cos(y[k]))) << y[k];
      }
    }
  }
}

TEST(DotOfLanes, IsTheSumOfProductsForEveryLength) {
  for (std::size_t n = 0; n < 80; ++n) {
    std::vector<double> a(n), b(n);
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      a[i] = static_cast<double>(i + 1);
      b[i] = static_cast<double>(3 * i % 7) - 2.0;
      sum += a[i] * b[i];
    }
    EXPECT_EQ(dot(a.data(), b.data(), n), sum) << n;
  }
}

TEST(AssignByLines, WritesEveryNumberAndNoOtherWhereverTheResultBegins) {
  for (std::size_t n = 0; n < 40; ++n) {
    for (std::size_t start = 0; start < 8; ++start) {
      AlignedVector result(64, -1.0);
      std::vector<double> x(n);
      for (std::size_t i = 0; i < n; ++i) x[i] = static_cast<double>(i) + 0.5;
      const double* from = x.data();
      assign_by_lines(result.data() + start, n, [=](auto at) { return 3.0 * at(from); });
      for (std::size_t i = 0; i < result.size(); ++i) {
        const bool inside = i >= start && i < start + n;
        EXPECT_EQ(result[i], inside ? 3.0 * x[i - start] : -1.0) << n << " from " << start;
      }
    }
  }
}

TEST(QuadraticForm, IsThatOfTheProductForEverySizeAndBandwidth) {
  for (std::size_t bandwidth = 0; bandwidth <= 3; ++bandwidth) {
    for (std::size_t n = 1; n < 40; ++n) {
      BandedMatrix matrix(n, bandwidth);
      std::vector<double> x(n), product(n);
      for (std::size_t i = 0; i < n; ++i) {
        x[i] = static_cast<double>(5 * i % 11) - 4.0;
        for (std::size_t j = i; j <= std::min(i + bandwidth, n - 1); ++j) {
          matrix.at(i, j) = static_cast<double>((i + 2 * j) % 5) + 1.0;
        }
      }
      matrix.multiply(x, product);
      EXPECT_EQ(matrix.quadratic_form(x), dot(x.data(), product.data(), n)) << n;
    }
  }
}

}  // namespace
}  // namespace subimpact
