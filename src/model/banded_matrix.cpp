#include "model/banded_matrix.h"

#include <algorithm>

#include "model/lanes.h"

namespace subimpact {

void BandedMatrix::multiply(std::span<const double> x, std::span<double> result) const {
  for (std::size_t i = 0; i < size_; ++i) result[i] = values_[i] * x[i];
  for (std::size_t k = 1; k <= half_bandwidth_; ++k) {
    const double* off = values_.data() + k * size_;
    for (std::size_t i = 0; i + k < size_; ++i) {
      result[i] += off[i] * x[i + k];
      result[i + k] += off[i] * x[i];
    }
  }
}

double BandedMatrix::quadratic_form(std::span<const double> x) const {
  double total = 0.0;
  for (std::size_t k = 0; k <= half_bandwidth_; ++k) {
    const double* off = values_.data() + k * size_;
    const std::size_t n = size_ - std::min(k, size_);
    Lanes running{};
    std::size_t i = 0;
    for (; i + n_lanes <= n; i += n_lanes) {
      running += lanes_at(off + i) * lanes_at(x.data() + i) * lanes_at(x.data() + i + k);
    }
    double sum_off = sum(running);
    for (; i < n; ++i) sum_off += off[i] * x[i] * x[i + k];
    total += k == 0 ? sum_off : 2.0 * sum_off;
  }
  return total;
}

bool BandedMatrix::is_positive_definite() const {
  BandedMatrix factor(size_, half_bandwidth_);  // unit lower triangle; D on the diagonal
  for (std::size_t j = 0; j < size_; ++j) {
    const std::size_t first = j > half_bandwidth_ ? j - half_bandwidth_ : 0;
    double pivot = at(j, j);
    for (std::size_t k = first; k < j; ++k) {
      pivot -= factor.at(j, k) * factor.at(j, k) * factor.at(k, k);
    }
    if (!(pivot > 0.0)) return false;
    factor.at(j, j) = pivot;
    for (std::size_t i = j + 1; i <= std::min(j + half_bandwidth_, size_ - 1); ++i) {
      double sum = at(i, j);
      for (std::size_t k = i > half_bandwidth_ ? i - half_bandwidth_ : 0; k < j; ++k) {
        sum -= factor.at(i, k) * factor.at(j, k) * factor.at(k, k);
      }
      factor.at(i, j) = sum / pivot;
    }
  }
  return true;
}

}  // namespace subimpact
