#pragma once

#include <Eigen/Core>
#include <cmath>
#include <span>

#include "numerics/dense.h"
#include "random_walk.h"
#include "subimpact/numerics/banded_matrix.h"

namespace subimpact {

inline Eigen::MatrixXd dense(const BandedMatrix& matrix) {
  const Eigen::Index n = index(matrix.size());
  Eigen::MatrixXd full(n, n);
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (std::size_t j = 0; j < matrix.size(); ++j) full(index(i), index(j)) = matrix(i, j);
  }
  return full;
}

/// A symmetric positive definite banded matrix without repeating rows: A = L L^T of a random L.
inline BandedMatrix random_positive_definite(std::size_t n, std::size_t half_bandwidth,
                                             unsigned seed) {
  const std::vector<double> numbers = random_numbers(seed, n * (half_bandwidth + 1));
  BandedMatrix lower(n, half_bandwidth);
  std::size_t next = 0;
  for (std::size_t j = 0; j < n; ++j) {
    lower.at(j, j) = 1.5 + 0.5 * numbers[next++];
    for (std::size_t i = j + 1; i < n && i <= j + half_bandwidth; ++i) {
      lower.at(i, j) = 0.4 * numbers[next++];
    }
  }
  const auto factor = [&](std::size_t i, std::size_t k) { return i >= k ? lower(i, k) : 0.0; };
  BandedMatrix matrix(n, half_bandwidth);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = j; i < n && i <= j + half_bandwidth; ++i) {
      double sum = 0.0;
      for (std::size_t k = i > half_bandwidth ? i - half_bandwidth : 0; k <= j; ++k) {
        sum += factor(i, k) * factor(j, k);
      }
      matrix.at(i, j) = sum;
    }
  }
  return matrix;
}

/// max_i |a_i|.
inline double largest_of(std::span<const double> a) {
  double largest = 0.0;
  for (const double x : a) largest = std::fmax(largest, std::abs(x));
  return largest;
}

/// max_i |a_i - b_i| over max_i |b_i|.
inline double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference = std::fmax(difference, std::abs(a[i] - b[i]));
  return difference / largest_of(b);
}

}  // namespace subimpact
