#include "numerics/mass_solver.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <optional>
#include <stdexcept>

namespace subimpact {
namespace {

constexpr std::size_t block_size = n_lanes;
using Block = Eigen::Matrix<double, block_size, block_size>;

// D x - P z for one block: D is 8 x 8, P is 8 x width, z the `width` entries of `neighbour` from
// `first` on.
template <std::size_t width>
class BlockProduct {
 public:
  // Column by column, D then P; in registers while it lasts.
  explicit BlockProduct(const double* coefficients) {
    for (std::size_t c = 0; c < block_size + width; ++c) {
      column_[c] = lanes_at(coefficients + c * block_size);
    }
  }
  Lanes operator()(const double* x, const Lanes& neighbour, std::size_t first) const {
    // Two partial sums, so that the products with x do not wait for each other. The neighbour comes
    // last and in a register: it has only just been computed, and everything waits for it.
    Lanes even = column_[0] * x[0];
    Lanes odd = column_[1] * x[1];
    for (std::size_t c = 2; c < block_size; c += 2) {
      even += column_[c] * x[c];
      odd += column_[c + 1] * x[c + 1];
    }
    even += odd;
    for (std::size_t c = 0; c < width; ++c) even -= column_[block_size + c] * neighbour[first + c];
    return even;
  }

 private:
  Lanes column_[block_size + width];
};

// The index of `coefficients` among those stored, stored now if new. A uniform mesh's factor
// settles to a repeating pattern, so few blocks differ and all stay in the nearest cache.
std::size_t store_once(AlignedVector& stored, const std::vector<double>& coefficients) {
  const std::size_t size = coefficients.size();
  for (std::size_t at = stored.size(); at > 0; at -= size) {
    const auto candidate = stored.begin() + static_cast<std::ptrdiff_t>(at - size);
    if (std::equal(coefficients.begin(), coefficients.end(), candidate)) return at - size;
  }
  stored.insert(stored.end(), coefficients.begin(), coefficients.end());
  return stored.size() - size;
}

}  // namespace

BandedSolver::BandedSolver(const BandedMatrix& matrix)
    : size_(matrix.size()),
      n_blocks_((matrix.size() + block - 1) / block),
      half_bandwidth_(matrix.half_bandwidth()) {
  static_assert(block == block_size);
  if (half_bandwidth_ > 3) throw std::invalid_argument("banded solver: half bandwidth above 3");
  const std::optional<BandedMatrix> factor = matrix.cholesky_factor();
  if (!factor) throw std::invalid_argument("banded solver: matrix not positive definite");
  if (half_bandwidth_ == 0) {
    for (std::size_t i = 0; i < size_; ++i) coefficients_.push_back(1.0 / matrix.at(i, i));
    return;
  }
  // The factor, filled up to whole blocks with the identity.
  const auto entry = [&](std::size_t i, std::size_t j) {
    return i < size_ ? (*factor)(i, j) : i == j ? 1.0 : 0.0;
  };
  const std::size_t stride = block * (block + half_bandwidth_);
  std::vector<double> down(stride);
  std::vector<double> up(stride);
  for (std::size_t b = 0; b < n_blocks_; ++b) {
    const std::size_t first = b * block;
    Block lower = Block::Zero();
    for (std::size_t j = 0; j < block; ++j) {
      for (std::size_t i = j; i < block; ++i) {
        lower(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            entry(first + i, first + j);
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
        if (b > 0) before(row, column) = entry(first + r, first - half_bandwidth_ + c);
        if (b + 1 < n_blocks_) after(row, column) = entry(first + block + c, first + r);
      }
    }
    const Block coupling_before = inverse * before;
    const Block coupling_after = inverse.transpose() * after;
    Eigen::Map<Block>(down.data()) = inverse;
    Eigen::Map<Block>(up.data()) = inverse.transpose();
    std::copy_n(coupling_before.data(), block * half_bandwidth_, down.data() + block * block);
    std::copy_n(coupling_after.data(), block * half_bandwidth_, up.data() + block * block);
    add_block(forward_, b, store_once(coefficients_, down));
    add_block(backward_, b, store_once(coefficients_, up));
  }
  std::reverse(backward_.begin(), backward_.end());
}

void BandedSolver::add_block(std::vector<Run>& runs, std::size_t b, std::size_t coefficients) {
  if (runs.empty() || runs.back().coefficients != coefficients)
    runs.push_back({coefficients, b, 0});
  ++runs.back().count;
}

template <std::size_t width>
void BandedSolver::solve_with(double* x) const {
  const std::size_t n_whole = size_ / block;
  const std::size_t rest = size_ % block;
  double tail[block] = {};  // the last block, if it is not whole
  std::copy_n(x + n_whole * block, rest, tail);
  const auto place = [&](std::size_t b) { return b < n_whole ? x + b * block : tail; };
  Lanes neighbour{};
  for (const Run& run : forward_) {
    const BlockProduct<width> product(coefficients_.data() + run.coefficients);
    for (std::size_t b = run.first; b < run.first + run.count; ++b) {
      neighbour = product(place(b), neighbour, block - width);
      store(neighbour, place(b));
    }
  }
  neighbour = Lanes{};
  for (const Run& run : backward_) {
    const BlockProduct<width> product(coefficients_.data() + run.coefficients);
    for (std::size_t b = run.first + run.count; b-- > run.first;) {
      neighbour = product(place(b), neighbour, 0);
      store(neighbour, place(b));
    }
  }
  std::copy_n(tail, rest, x + n_whole * block);
}

void BandedSolver::solve(std::span<double> x) const {
  assert(x.size() == size_);
  switch (half_bandwidth_) {
    case 0:
      for (std::size_t i = 0; i < size_; ++i) x[i] *= coefficients_[i];
      return;
    case 1:
      return solve_with<1>(x.data());
    case 2:
      return solve_with<2>(x.data());
    default:
      return solve_with<3>(x.data());
  }
}

}  // namespace subimpact
