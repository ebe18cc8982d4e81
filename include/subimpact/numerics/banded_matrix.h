#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace subimpact {

/// Symmetric banded matrix, stored by its diagonals: diagonal(k)[i] = A(i + k, i).
class BandedMatrix {
 public:
  BandedMatrix(std::size_t size, std::size_t half_bandwidth)
      : size_(size), half_bandwidth_(half_bandwidth), values_(size * (half_bandwidth + 1), 0.0) {}

  std::size_t size() const { return size_; }
  void set_zero() { values_.assign(values_.size(), 0.0); }
  std::size_t half_bandwidth() const { return half_bandwidth_; }

  /// Entry (i, j) with |i - j| <= half_bandwidth; either triangle names the same entry.
  double& at(std::size_t i, std::size_t j) { return values_[index(i, j)]; }
  double at(std::size_t i, std::size_t j) const { return values_[index(i, j)]; }
  /// As at(), and zero outside the band.
  double operator()(std::size_t i, std::size_t j) const {
    const std::size_t apart = i > j ? i - j : j - i;
    return apart > half_bandwidth_ ? 0.0 : at(i, j);
  }

  /// Adds `factor` times another matrix of the same size, of a half bandwidth up to this one's.
  void add(double factor, const BandedMatrix& other);
  /// result = A x.
  void multiply(std::span<const double> x, std::span<double> result) const;
  /// result -= A x.
  void subtract_product(std::span<const double> x, std::span<double> result) const;
  /// L of A = L L^T, lower triangular, by at(i, j), i >= j; nothing if A is not positive definite.
  std::optional<BandedMatrix> cholesky_factor() const;
  /// Overwrites b by the solution x of L L^T x = b, this matrix being such an L.
  void solve_as_factor(std::span<double> x) const;
  /// x^T A x.
  double quadratic_form(std::span<const double> x) const;

 private:
  std::size_t index(std::size_t i, std::size_t j) const {
    const std::size_t apart = i > j ? i - j : j - i;
    assert(apart <= half_bandwidth_ && std::max(i, j) < size_);
    return apart * size_ + std::min(i, j);
  }

  std::size_t size_;
  std::size_t half_bandwidth_;
  std::vector<double> values_;
};

}  // namespace subimpact
