#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "subimpact/case/case_keys.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// Values of one key, or of several keys that change together.
struct PopulationAxis {
  std::vector<std::string> keys;
  std::vector<std::vector<KeyValue>> points;  ///< each with one value per key
};

/// Cases that differ from a base case in the values of some keys: every combination of the points
/// of all axes, each with `n_samples` samples of the numbers that scatter.
///
/// A number p that scatters with the relative standard deviation s has the values p exp(s z), with
/// z normal and p the value on the axis or else in the base case. Seed and number of a sample
/// determine its z for all keys, at every combination of the axes; values that a key refuses are
/// drawn again.
struct Population {
  std::vector<PopulationAxis> axes;       ///< the points of the last one change fastest
  std::map<std::string, double> scatter;  ///< s by key; independent of each other
  std::size_t n_samples = 1;
  std::uint64_t seed = 1;

  std::size_t size() const;
  /// The keys whose values differ, in the order of axes and then of scatter; each once.
  std::vector<std::string> keys() const;
  /// The values of these keys in case `number`, from 0; samples change fastest.
  std::vector<std::pair<std::string, KeyValue>> settings(const Case& base,
                                                         std::size_t number) const;
};

/// The scatter of the case itself: deviations above 0 in its [scatter], of numbers that are finite
/// and not 0 on an axis or else in the base case.
std::map<std::string, double> scatter_of(const Case& base, const std::vector<PopulationAxis>& axes);

/// The result of every case of a population, in their order, `jobs` runs at a time; none keeps
/// rows. Throws InvalidCase.
std::vector<Result> sweep(const Case& base, const Population& population, unsigned jobs = 1);

/// Throws InvalidCase for a key that is unknown, on two axes, without values or with values that it
/// does not allow, and for scatter of a key that is not a finite number in the base case.
void check(const Population& population, const Case& base);

}  // namespace subimpact
