// Operations on eight numbers at once against the same one by one.

#include "numerics/lanes.h"
#include "numerics/vector_sum.h"
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

// Small whole numbers, so that every order of additions gives the same sum.
double entry(std::size_t k, std::size_t i) {
  return static_cast<double>((7 * k + 3 * i) % 11) - 5.0;
}
double weight(std::size_t k) { return static_cast<double>(k % 4) + 0.5; }

struct Example {
  std::vector<std::vector<double>> vectors;
  std::vector<double> expected;
  VectorSum sum;

  Example(std::size_t n_terms, std::size_t n) : vectors(n_terms), expected(n, 0.0) {
    for (std::size_t k = 0; k < n_terms; ++k) {
      for (std::size_t i = 0; i < n; ++i) {
        vectors[k].push_back(entry(k, i));
        expected[i] += weight(k) * entry(k, i);
      }
      sum.add(weight(k), vectors[k].data());
    }
  }
};

TEST(VectorSum, IsTheSumForEveryNumberOfTermsAndEveryLength) {
  for (std::size_t n_terms = 0; n_terms <= VectorSum::most_terms; ++n_terms) {
    for (const std::size_t n : {1u, 7u, 8u, 9u, 31u, 64u}) {
      SCOPED_TRACE(testing::Message() << n_terms << " terms of length " << n);
      const Example example(n_terms, n);
      std::vector<double> out(n + 1, 42.0);
      example.sum.write(out.data(), n);
      EXPECT_EQ(out.back(), 42.0);
      out.pop_back();
      EXPECT_EQ(out, example.expected);
      double squares = 0.0;
      for (const double value : example.expected) squares += value * value;
      EXPECT_EQ(example.sum.sum_of_squares(n), squares);
    }
  }
}

TEST(VectorSum, RefusesMoreTermsThanItHolds) {
  const double one = 1.0;
  VectorSum sum;
  for (std::size_t k = 0; k < VectorSum::most_terms; ++k) {
    EXPECT_FALSE(sum.is_full());
    sum.add(1.0, &one);
  }
  EXPECT_TRUE(sum.is_full());
  EXPECT_THROW(sum.add(1.0, &one), std::length_error);
}

}  // namespace
}  // namespace subimpact
