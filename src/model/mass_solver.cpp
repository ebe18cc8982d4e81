#include "model/mass_solver.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace subimpact {
namespace {

constexpr std::size_t block_size = 8;
using Block = Eigen::Matrix<double, block_size, block_size>;

// Lower-banded Cholesky factor, padded with the identity to a whole number of blocks.
BandedMatrix cholesky_factor(const BandedMatrix& a, std::size_t padded) {
  const std::size_t bandwidth = a.half_bandwidth();
  BandedMatrix factor(padded, bandwidth);
  for (std::size_t j = 0; j < padded; ++j) {
    if (j >= a.size()) {
      factor.at(j, j) = 1.0;
      continue;
    }
    double pivot = a.at(j, j);
    const std::size_t first = j > bandwidth ? j - bandwidth : 0;
    for (std::size_t k = first; k < j; ++k) pivot -= factor.at(j, k) * factor.at(j, k);
    if (!(pivot > 0.0)) throw std::invalid_argument("banded solver: matrix not positive definite");
    factor.at(j, j) = std::sqrt(pivot);
    for (std::size_t i = j + 1; i <= std::min(j + bandwidth, a.size() - 1); ++i) {
      double sum = a.at(i, j);
      for (std::size_t k = i > bandwidth ? i - bandwidth : 0; k < j; ++k) {
        sum -= factor.at(i, k) * factor.at(j, k);
      }
      factor.at(i, j) = sum / factor.at(j, j);
    }
  }
  return factor;
}

// y = D x - P z for one block; D is 8 x 8, P is 8 x width, both column by column.
inline void apply_block(const double* coefficients, std::size_t width, const double* x,
                        const double* z, double* y) {
  double sum[block_size] = {};
  for (std::size_t c = 0; c < block_size; ++c) {
    const double* column = coefficients + c * block_size;
    for (std::size_t r = 0; r < block_size; ++r) sum[r] += column[r] * x[c];
  }
  for (std::size_t c = 0; c < width; ++c) {
    const double* column = coefficients + (block_size + c) * block_size;
    for (std::size_t r = 0; r < block_size; ++r) sum[r] -= column[r] * z[c];
  }
  for (std::size_t r = 0; r < block_size; ++r) y[r] = sum[r];
}

}  // namespace

BandedSolver::BandedSolver(const BandedMatrix& matrix)
    : size_(matrix.size()),
      n_blocks_((matrix.size() + block - 1) / block),
      half_bandwidth_(matrix.half_bandwidth()),
      work_(n_blocks_ * block, 0.0) {
  static_assert(block == block_size);
  if (half_bandwidth_ > block) throw std::invalid_argument("banded solver: bandwidth above 8");
  const BandedMatrix factor = cholesky_factor(matrix, n_blocks_ * block);
  const std::size_t stride = block * (block + half_bandwidth_);
  forward_.resize(n_blocks_ * stride);
  backward_.resize(n_blocks_ * stride);
  for (std::size_t b = 0; b < n_blocks_; ++b) {
    const std::size_t first = b * block;
    Block lower = Block::Zero();
    for (std::size_t j = 0; j < block; ++j) {
      for (std::size_t i = j; i < block; ++i) {
        lower(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            factor(first + i, first + j);
      }
    }
    const Block inverse = lower.triangularView<Eigen::Lower>().solve(Block::Identity());
    // What the last unknowns of the block before contribute, and the first ones of the block after.
    Block before = Block::Zero();
    Block after = Block::Zero();
    for (std::size_t c = 0; c < half_bandwidth_; ++c) {
      for (std::size_t r = 0; r < block; ++r) {
        const auto row = static_cast<Eigen::Index>(r);
        const auto column = static_cast<Eigen::Index>(c);
        if (b > 0) before(row, column) = factor(first + r, first - half_bandwidth_ + c);
        if (b + 1 < n_blocks_) after(row, column) = factor(first + block + c, first + r);
      }
    }
    const Block coupling_before = inverse * before;
    const Block coupling_after = inverse.transpose() * after;
    double* down = forward_.data() + b * stride;
    double* up = backward_.data() + b * stride;
    Eigen::Map<Block>(down, block, block) = inverse;
    Eigen::Map<Block>(up, block, block) = inverse.transpose();
    std::copy_n(coupling_before.data(), block * half_bandwidth_, down + block * block);
    std::copy_n(coupling_after.data(), block * half_bandwidth_, up + block * block);
  }
}

void BandedSolver::solve(std::span<double> x) const {
  const std::size_t stride = block * (block + half_bandwidth_);
  const std::size_t width = half_bandwidth_;
  double* work = work_.data();
  std::copy_n(x.data(), size_, work);
  const double none[block] = {};
  const double* previous = none;
  for (std::size_t b = 0; b < n_blocks_; ++b) {
    double* here = work + b * block;
    apply_block(forward_.data() + b * stride, width, here, previous, here);
    previous = here + block - width;
  }
  const double* next = none;
  for (std::size_t b = n_blocks_; b-- > 0;) {
    double* here = work + b * block;
    apply_block(backward_.data() + b * stride, width, here, next, here);
    next = here;
  }
  std::copy_n(work, size_, x.data());
}

}  // namespace subimpact
