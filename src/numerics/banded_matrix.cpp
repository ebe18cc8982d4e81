#include "subimpact/numerics/banded_matrix.h"

#include <cmath>

#include "numerics/lanes.h"

namespace subimpact {

void BandedMatrix::add(double factor, const BandedMatrix& other) {
  assert(other.values_.size() <= values_.size());
  for (std::size_t i = 0; i < other.values_.size(); ++i) values_[i] += factor * other.values_[i];
}

void BandedMatrix::multiply(std::span<const double> x, std::span<double> result) const {
  assert(x.size() == size_ && result.size() == size_);
  for (std::size_t i = 0; i < size_; ++i) result[i] = values_[i] * x[i];
  for (std::size_t k = 1; k <= half_bandwidth_; ++k) {
    const double* off = values_.data() + k * size_;
    for (std::size_t i = 0; i + k < size_; ++i) {
      result[i] += off[i] * x[i + k];
      result[i + k] += off[i] * x[i];
    }
  }
}

void BandedMatrix::subtract_product(std::span<const double> x, std::span<double> result) const {
  for (std::size_t i = 0; i < size_; ++i) {
    result[i] -= at(i, i) * x[i];
    for (std::size_t k = 1; k <= half_bandwidth_ && i + k < size_; ++k) {
      const double entry = at(i, i + k);
      result[i] -= entry * x[i + k];
      result[i + k] -= entry * x[i];
    }
  }
}

double BandedMatrix::quadratic_form(std::span<const double> x) const {
  assert(x.size() == size_);
  const double* at = x.data();
  const std::size_t width = std::min(half_bandwidth_ + 1, size_);
  const std::size_t whole = (size_ + 1 - width) / n_lanes * n_lanes;
  // Diagonals off the main one count twice: below it and above.
  Lanes main{};
  Lanes beside{};
  for (std::size_t i = 0; i < whole; i += n_lanes) {
    const Lanes here = lanes_at(at + i);
    main += lanes_at(values_.data() + i) * here * here;
    for (std::size_t k = 1; k < width; ++k) {
      beside += lanes_at(values_.data() + k * size_ + i) * here * lanes_at(at + i + k);
    }
  }
  double total = sum(main) + 2.0 * sum(beside);
  for (std::size_t i = whole; i < size_; ++i) {
    total += values_[i] * at[i] * at[i];
    for (std::size_t k = 1; k < width && i + k < size_; ++k) {
      total += 2.0 * values_[k * size_ + i] * at[i] * at[i + k];
    }
  }
  return total;
}

std::optional<BandedMatrix> BandedMatrix::cholesky_factor() const {
  BandedMatrix factor(size_, half_bandwidth_);
  for (std::size_t j = 0; j < size_; ++j) {
    const std::size_t last = std::min(j + half_bandwidth_, size_ - 1);
    for (std::size_t i = j; i <= last; ++i) {
      double rest = at(i, j);
      for (std::size_t k = i > half_bandwidth_ ? i - half_bandwidth_ : 0; k < j; ++k) {
        rest -= factor.at(i, k) * factor.at(j, k);
      }
      if (i == j && !(rest > 0.0)) return std::nullopt;
      factor.at(i, j) = i == j ? std::sqrt(rest) : rest / factor.at(j, j);
    }
  }
  return factor;
}

void BandedMatrix::solve_as_factor(std::span<double> x) const {
  assert(x.size() == size_);
  for (std::size_t j = 0; j < size_; ++j) {
    x[j] /= at(j, j);
    const std::size_t last = std::min(j + half_bandwidth_, size_ - 1);
    for (std::size_t i = j + 1; i <= last; ++i) x[i] -= at(i, j) * x[j];
  }
  for (std::size_t j = size_; j-- > 0;) {
    const std::size_t last = std::min(j + half_bandwidth_, size_ - 1);
    for (std::size_t i = j + 1; i <= last; ++i) x[j] -= at(i, j) * x[i];
    x[j] /= at(j, j);
  }
}

}  // namespace subimpact
