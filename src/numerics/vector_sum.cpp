#include "numerics/vector_sum.h"

#include <algorithm>
#include <utility>

#include "numerics/lanes.h"

namespace subimpact {
namespace {

template <std::size_t N>
void write_terms(const double* weights, const double* const* vectors, double* out, std::size_t n) {
  std::array<double, N> w;  // copies that no store to the output can change
  std::array<const double*, N> x;
  std::copy_n(weights, N, w.begin());
  std::copy_n(vectors, N, x.begin());
#pragma GCC ivdep
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0.0;
    if constexpr (N > 0) sum = w[0] * x[0][i];
    for (std::size_t k = 1; k < N; ++k) sum += w[k] * x[k][i];
    out[i] = sum;
  }
}

template <std::size_t N>
double square_terms(const double* weights, const double* const* vectors, std::size_t n) {
  Lanes running{};
  std::size_t i = 0;
  for (; i + n_lanes <= n; i += n_lanes) {
    Lanes here{};
    for (std::size_t k = 0; k < N; ++k) here += weights[k] * lanes_at(vectors[k] + i);
    running += here * here;
  }
  double total = sum(running);
  for (; i < n; ++i) {
    double here = 0.0;
    for (std::size_t k = 0; k < N; ++k) here += weights[k] * vectors[k][i];
    total += here * here;
  }
  return total;
}

// Kernels for 0, 1, ... terms.
template <class Kernel, std::size_t... N>
constexpr auto kernels_of(Kernel kernel, std::index_sequence<N...>) {
  return std::array{kernel(std::integral_constant<std::size_t, N>())...};
}

// More terms than this have too many addresses for the processor's registers.
constexpr std::size_t most_at_once = 10;

}  // namespace

void VectorSum::write(double* out, std::size_t n) const {
  static constexpr auto kernels = kernels_of([](auto count) { return &write_terms<count>; },
                                             std::make_index_sequence<most_at_once + 1>());
  std::size_t done = std::min(count_, most_at_once);
  kernels[done](weights_.data(), vectors_.data(), out, n);
  while (done < count_) {  // the sum so far and some more terms
    const std::size_t more = std::min(count_ - done, most_at_once - 1);
    std::array<double, most_at_once> weights{1.0};
    std::array<const double*, most_at_once> vectors{out};
    std::copy_n(weights_.begin() + done, more, weights.begin() + 1);
    std::copy_n(vectors_.begin() + done, more, vectors.begin() + 1);
    kernels[more + 1](weights.data(), vectors.data(), out, n);
    done += more;
  }
}

double VectorSum::sum_of_squares(std::size_t n) const {
  static constexpr auto kernels = kernels_of([](auto count) { return &square_terms<count>; },
                                             std::make_index_sequence<most_terms + 1>());
  return kernels[count_](weights_.data(), vectors_.data(), n);
}

}  // namespace subimpact
