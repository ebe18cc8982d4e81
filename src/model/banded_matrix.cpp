#include "model/banded_matrix.h"

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
  double sum = 0.0;
  for (std::size_t i = 0; i < size_; ++i) sum += values_[i] * x[i] * x[i];
  for (std::size_t k = 1; k <= half_bandwidth_; ++k) {
    const double* off = values_.data() + k * size_;
    for (std::size_t i = 0; i + k < size_; ++i) sum += 2.0 * off[i] * x[i] * x[i + k];
  }
  return sum;
}

}  // namespace subimpact
