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

// Richardson extrapolation of values v(h) = v(0) + c h^p, computed with mesh widths or steps h that
// get finer.

/// v(0) from v(h) = coarse and v(h/ratio) = fine.
inline double richardson_limit(double coarse, double fine, double ratio, double order) {
  assert(ratio > 1.0 && order > 0.0);
  return fine + (fine - coarse) / (std::pow(ratio, order) - 1.0);
}

/// (v(h1) - v(h2))/(v(h2) - v(h3)), h1 > h2 > h3, by which values show their order.
inline double ratio_of_differences(double h1, double h2, double h3, double order) {
  assert(h1 > h2 && h2 > h3 && order > 0.0);
  return (std::pow(h1, order) - std::pow(h2, order)) / (std::pow(h2, order) - std::pow(h3, order));
}

}  // namespace subimpact
