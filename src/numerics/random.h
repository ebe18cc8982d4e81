#pragma once

/// Random numbers that are the same on every machine and with every standard library.

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace subimpact {

/// Steele, Lea and Flood 2014, SplitMix64, with transforms of our own.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  /// From 0 (included) to 1 (not).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  double log_uniform(double low, double high) {
    return low * std::exp(uniform() * std::log(high / low));
  }
  bool chance(double probability) { return uniform() < probability; }
  /// From 0 to n - 1.
  std::size_t index(std::size_t n) {
    return static_cast<std::size_t>(uniform() * static_cast<double>(n));
  }

  /// One of a list.
  template <class List>
  const auto& one_of(const List& list) {
    return list[index(list.size())];
  }

 private:
  std::uint64_t state_;
};

}  // namespace subimpact
