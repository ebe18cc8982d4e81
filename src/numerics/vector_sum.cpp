#include "numerics/vector_sum.h"

#include <algorithm>
#include <stdexcept>

#include "numerics/lanes.h"

namespace subimpact {
namespace {

// N terms, in copies that no store to an output can change.
template <std::size_t N>
struct Terms {
  std::array<double, N> weights;
  std::array<const double*, N> vectors;
  Terms(const double* w, const double* const* v) {
    std::copy_n(w, N, weights.begin());
    std::copy_n(v, N, vectors.begin());
  }
};

template <std::size_t N>
void write_terms(const Terms<N> terms, double* out, std::size_t n) {
#pragma GCC ivdep
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0.0;
    if constexpr (N > 0) sum = terms.weights[0] * terms.vectors[0][i];
    for (std::size_t k = 1; k < N; ++k) sum += terms.weights[k] * terms.vectors[k][i];
    out[i] = sum;
  }
}

template <std::size_t N>
double squares(const Terms<N> terms, std::size_t n) {
  Lanes running{};
  std::size_t i = 0;
  for (; i + n_lanes <= n; i += n_lanes) {
    Lanes here{};
    for (std::size_t k = 0; k < N; ++k) here += terms.weights[k] * lanes_at(terms.vectors[k] + i);
    running += here * here;
  }
  double total = sum(running);
  for (; i < n; ++i) {
    double here = 0.0;
    for (std::size_t k = 0; k < N; ++k) here += terms.weights[k] * terms.vectors[k][i];
    total += here * here;
  }
  return total;
}

// Calls f with the terms, their number known to the compiler.
template <std::size_t N = 0, class F>
auto with_terms(std::size_t count, const double* weights, const double* const* vectors, F f) {
  if constexpr (N < VectorSum::most_terms) {
    if (count > N) return with_terms<N + 1>(count, weights, vectors, f);
  }
  return f(Terms<N>(weights, vectors));
}

}  // namespace

void VectorSum::add(double weight, const double* vector) {
  if (weight == 0.0) return;
  if (is_full()) throw std::length_error("VectorSum: more than 20 vectors");
  weights_[count_] = weight;
  vectors_[count_] = vector;
  ++count_;
}

void VectorSum::write(double* out, std::size_t n) const {
  with_terms(count_, weights_.data(), vectors_.data(),
             [&](const auto& terms) { write_terms(terms, out, n); });
}

double VectorSum::sum_of_squares(std::size_t n) const {
  return with_terms(count_, weights_.data(), vectors_.data(),
                    [&](const auto& terms) { return squares(terms, n); });
}

}  // namespace subimpact
