#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace subimpact {

/// The upper median; 0 of no values.
inline double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// v(0) from v(h) = v(0) + c h^order = coarse and v(h/ratio) = fine, by Richardson.
inline double richardson_limit(double coarse, double fine, double ratio, double order) {
  assert(ratio > 1.0 && order > 0.0);
  return fine + (fine - coarse) / (std::pow(ratio, order) - 1.0);
}

}  // namespace subimpact
