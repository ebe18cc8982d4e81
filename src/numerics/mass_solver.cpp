#include "numerics/mass_solver.h"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <optional>
#include <stdexcept>
#include <type_traits>

namespace subimpact {
namespace {

constexpr std::size_t block_size = n_lanes;
using Block = Eigen::Matrix<double, block_size, block_size>;

Eigen::Index row(std::size_t i) { return static_cast<Eigen::Index>(i); }

enum class Direction { down, up };

// One block's part of a substitution: D x - P z with D 8 x 8, P 8 x width, z the nearest `width`
// entries of the block before it in this direction.
template <std::size_t width, Direction direction>
class BlockStep {
 public:
  // Column by column, D then P.
  explicit BlockStep(const double* coefficients) : coefficients_(coefficients) {}
  // `carried`: of the block before, then of this one.
  Lanes operator()(const double* x, Lanes& carried) const {
    constexpr std::size_t nearest = direction == Direction::down ? block_size - width : 0;
    // Two partial sums, so that the products with x do not wait for each other. The neighbour comes
    // last and in a register: it has only just been computed, and everything waits for it.
    Lanes even = column(0) * x[0];
    Lanes odd = column(1) * x[1];
    for (std::size_t c = 2; c < block_size; c += 2) {
      even += column(c) * x[c];
      odd += column(c + 1) * x[c + 1];
    }
    even += odd;
    for (std::size_t c = 0; c < width; ++c) even -= column(block_size + c) * carried[nearest + c];
    carried = even;
    return even;
  }

 private:
  Lanes column(std::size_t c) const { return lanes_at(coefficients_ + c * block_size); }
  const double* coefficients_;
};

// The lanes moved by 1, 2 or 4 places, away from the block that is solved before this one.
template <Direction direction, int places>
Lanes moved(const Lanes& x) {
  const Lanes none{};
  constexpr int s = places;
  if constexpr (direction == Direction::down) {
    return __builtin_shufflevector(none, x, 8 - s, 9 - s, 10 - s, 11 - s, 12 - s, 13 - s, 14 - s,
                                   15 - s);
  } else {
    return __builtin_shufflevector(x, none, s, 1 + s, 2 + s, 3 + s, 4 + s, 5 + s, 6 + s, 7 + s);
  }
}

template <int lane>
Lanes in_all_lanes(const Lanes& x) {
  return __builtin_shufflevector(x, x, lane, lane, lane, lane, lane, lane, lane, lane);
}

// A block step for a recurrence y_i = x_i + g_i y_{i-1} (upwards: y_{i+1}). After the terms 1, 2
// and 4 places away every lane holds the sum over its own block; the block before adds its last y
// times the products of all g up to the lane.
template <Direction direction>
class RecurrenceStep {
 public:
  // Factors of the terms 1, 2 and 4 places away and of the block before, factor of the result.
  explicit RecurrenceStep(const double* coefficients) : coefficients_(coefficients) {}
  // `carried`: the last y of the block before, then of this one, in all lanes.
  Lanes operator()(const double* x, Lanes& carried) const {
    Lanes y = lanes_at(x);
    y += column(0) * moved<direction, 1>(y);
    y += column(1) * moved<direction, 2>(y);
    y += column(2) * moved<direction, 4>(y);
    const Lanes result = y + column(3) * carried;
    carried = in_all_lanes<last>(y) + coefficients_[3 * block_size + last] * carried;
    return direction == Direction::down ? result * column(4) : result;
  }

 private:
  static constexpr std::size_t last = direction == Direction::down ? block_size - 1 : 0;
  Lanes column(std::size_t c) const { return lanes_at(coefficients_ + c * block_size); }
  const double* coefficients_;
};

// Whether lanes move in one instruction; elsewhere that takes more than the full product.
#ifdef __AVX512F__
constexpr bool moves_lanes = true;
#else
constexpr bool moves_lanes = false;
#endif
template <std::size_t width, Direction direction>
using Step = std::conditional_t<width == 1 && moves_lanes, RecurrenceStep<direction>,
                                BlockStep<width, direction>>;

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

// An entry of the factor, filled up to whole blocks with the identity.
double entry(const BandedMatrix& factor, std::size_t i, std::size_t j) {
  if (i < factor.size()) return factor(i, j);
  return i == j ? 1.0 : 0.0;
}

// Coefficients of a block, for BlockStep or RecurrenceStep.
struct Coefficients {
  std::vector<double> down, up;
};

Coefficients products(const BandedMatrix& factor, std::size_t b) {
  const std::size_t width = factor.half_bandwidth();
  const std::size_t first = b * block_size;
  Block lower = Block::Zero();
  for (std::size_t j = 0; j < block_size; ++j) {
    for (std::size_t i = j; i < block_size; ++i) {
      lower(row(i), row(j)) = entry(factor, first + i, first + j);
    }
  }
  const Block inverse = lower.triangularView<Eigen::Lower>().solve(Block::Identity());
  // What the last unknowns of the block before contribute, and the first ones of the block after.
  Block before = Block::Zero();
  Block after = Block::Zero();
  for (std::size_t c = 0; c < width; ++c) {
    for (std::size_t r = 0; r < block_size; ++r) {
      if (b > 0) before(row(r), row(c)) = entry(factor, first + r, first - width + c);
      after(row(r), row(c)) = entry(factor, first + block_size + c, first + r);
    }
  }
  const auto columns = [width](const Block& diagonal, const Block& coupling) {
    std::vector<double> all(diagonal.data(), diagonal.data() + block_size * block_size);
    all.insert(all.end(), coupling.data(), coupling.data() + block_size * width);
    return all;
  };
  return {columns(inverse, inverse * before),
          columns(inverse.transpose(), inverse.transpose() * after)};
}

// The recurrences of A = L D L^T with ones on the diagonal of L.
Coefficients recurrences(const BandedMatrix& factor, std::size_t b) {
  // Factor of unknown i in the next one.
  const auto share = [&factor](std::size_t i) {
    return -entry(factor, i + 1, i) / entry(factor, i, i);
  };
  const std::size_t first = b * block_size;
  Coefficients result{std::vector<double>(5 * block_size, 0.0),
                      std::vector<double>(5 * block_size, 0.0)};
  for (std::size_t r = 0; r < block_size; ++r) {
    const std::size_t i = first + r;
    double down = 1.0;
    for (std::size_t away = 1; away <= r + 1 && away <= i; ++away) {
      down *= share(i - away);
      if (away <= r && (away == 1 || away == 2 || away == 4)) {
        result.down[away / 2 * block_size + r] = down;
      }
    }
    result.down[3 * block_size + r] = b > 0 ? down : 0.0;
    const double diagonal = entry(factor, i, i);
    result.down[4 * block_size + r] = 1.0 / (diagonal * diagonal);
    double up = 1.0;
    for (std::size_t away = 1; away <= block_size - r; ++away) {
      up *= share(i + away - 1);
      if (r + away < block_size && (away == 1 || away == 2 || away == 4)) {
        result.up[away / 2 * block_size + r] = up;
      }
    }
    result.up[3 * block_size + r] = up;
  }
  return result;
}

}  // namespace

BandedSolver::BandedSolver(const BandedMatrix& matrix)
    : size_(matrix.size()),
      n_blocks_((matrix.size() + block_size - 1) / block_size),
      half_bandwidth_(matrix.half_bandwidth()) {
  if (half_bandwidth_ > 3) throw std::invalid_argument("banded solver: half bandwidth above 3");
  const std::optional<BandedMatrix> factor = matrix.cholesky_factor();
  if (!factor) throw std::invalid_argument("banded solver: matrix not positive definite");
  if (half_bandwidth_ == 0) {
    for (std::size_t i = 0; i < size_; ++i) coefficients_.push_back(1.0 / matrix.at(i, i));
    return;
  }
  for (std::size_t b = 0; b < n_blocks_; ++b) {
    const auto [down, up] =
        half_bandwidth_ == 1 && moves_lanes ? recurrences(*factor, b) : products(*factor, b);
    down_.push_back(store_once(coefficients_, down));
    up_.push_back(store_once(coefficients_, up));
  }
}

template <std::size_t width>
void BandedSolver::solve_with(double* x) const {
  const std::size_t n_whole = size_ / block_size;
  const std::size_t rest = size_ % block_size;
  double tail[block_size] = {};  // the last block, if it is not whole
  std::copy_n(x + n_whole * block_size, rest, tail);
  const auto place = [&](std::size_t b) { return b < n_whole ? x + b * block_size : tail; };
  const double* coefficients = coefficients_.data();
  Lanes carried{};
  for (std::size_t b = 0; b < n_blocks_; ++b) {
    const Step<width, Direction::down> step(coefficients + down_[b]);
    store(step(place(b), carried), place(b));
  }
  carried = Lanes{};
  for (std::size_t b = n_blocks_; b-- > 0;) {
    const Step<width, Direction::up> step(coefficients + up_[b]);
    store(step(place(b), carried), place(b));
  }
  std::copy_n(tail, rest, x + n_whole * block_size);
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
