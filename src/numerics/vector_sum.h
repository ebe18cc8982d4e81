#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>

namespace subimpact {

/// A sum of weighted vectors, sum_k w_k x_k.
class VectorSum {
 public:
  static constexpr std::size_t most_terms = 20;

  /// Vectors of weight zero are left out. Throws std::length_error beyond most_terms.
  void add(double weight, const double* vector) {
    if (weight == 0.0) return;
    if (is_full()) throw std::length_error("VectorSum: too many vectors");
    weights_[count_] = weight;
    vectors_[count_] = vector;
    ++count_;
  }
  bool is_full() const { return count_ == most_terms; }

  /// The first n entries of the sum. `out` may be the first vector, but no other.
  void write(double* out, std::size_t n) const;
  double sum_of_squares(std::size_t n) const;

 private:
  std::array<double, most_terms> weights_;
  std::array<const double*, most_terms> vectors_;
  std::size_t count_ = 0;
};

}  // namespace subimpact
