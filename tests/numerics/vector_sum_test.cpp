#include "numerics/vector_sum.h"

#include "testing.h"

namespace subimpact {
namespace {

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

TEST(VectorSum, MayBeWrittenOverItsFirstVector) {
  for (std::size_t n_terms = 1; n_terms <= VectorSum::most_terms; ++n_terms) {
    Example example(n_terms, 37);
    example.sum.write(example.vectors.front().data(), 37);
    EXPECT_EQ(example.vectors.front(), example.expected) << n_terms;
  }
}

TEST(VectorSum, LeavesVectorsOfWeightZeroOut) {
  VectorSum sum;
  for (int i = 0; i < 100; ++i) sum.add(0.0, nullptr);
  double out = 1.0;
  sum.write(&out, 1);
  EXPECT_EQ(out, 0.0);
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
