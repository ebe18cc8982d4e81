#pragma once

#include <cmath>
#include <cstddef>

#include "random.h"

namespace subimpact {

/// Random numbers of the kinds that scenes are drawn from.
class Random : public SplitMix64 {
 public:
  using SplitMix64::SplitMix64;
  using SplitMix64::uniform;

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
};

}  // namespace subimpact
