#pragma once

#include <array>
#include <cstddef>

namespace subimpact {

/// A sum of weighted vectors, sum_k w_k x_k, evaluated in one pass over their entries.
class VectorSum {
 public:
  static constexpr std::size_t most_terms = 20;

  /// Vectors of weight zero are left out. Throws std::length_error beyond most_terms.
  void add(double weight, const double* vector);
  bool is_full() const { return count_ == most_terms; }

  /// The first n entries of the sum. `out` may be one of the vectors.
  void write(double* out, std::size_t n) const;
  /// The sum of the squares of the first n entries.
  double sum_of_squares(std::size_t n) const;

 private:
  std::array<double, most_terms> weights_;
  std::array<const double*, most_terms> vectors_;
  std::size_t count_ = 0;
};

}  // namespace subimpact
