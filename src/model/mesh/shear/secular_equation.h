#pragma once

#include <Eigen/Core>

#include "numerics/bracketed_root.h"

namespace subimpact {

/// Poles, ascending, and their weights, all positive: of sum weight / (pole - x).
struct Poles {
  Eigen::ArrayXd at, weight;

  Eigen::Index size() const { return at.size(); }
};

/// Measured from a pole, or from 0, so that its distances to the poles keep their digits.
struct SecularRoot {
  double origin, offset;

  double value() const { return origin + offset; }
  Eigen::ArrayXd distances(const Poles& poles) const { return poles.at - origin - offset; }
};

/// The root below pole i, and above the one before it or 0, of sum weight / (pole - x) = right(x):
/// one where `right` does not rise. The equation is taken times the distances to the poles beside
/// the root, in which it has no poles.
template <class Right>
SecularRoot root_below(const Poles& poles, Eigen::Index i, Right right) {
  const Eigen::Index n = poles.size();
  const bool has_lower = i > 0;
  const double low = has_lower ? poles.at[i - 1] : 0.0;
  const double low_weight = has_lower ? poles.weight[i - 1] : 0.0;
  const double gap = poles.at[i] - low;
  const Eigen::Index n_before = has_lower ? i - 1 : 0;
  const Eigen::Index n_after = n - i - 1;
  const auto condition = [&](double origin, double from_low, double from_high, double offset) {
    const auto sum = [&](Eigen::Index first, Eigen::Index count) {
      return (poles.weight.segment(first, count) /
              (poles.at.segment(first, count) - origin - offset))
          .sum();
    };
    const double lower = has_lower ? from_low : 1.0;
    const double of_beside = poles.weight[i] * lower - low_weight * from_high;
    if (lower * from_high == 0.0) return of_beside;
    const double rest = sum(0, n_before) + sum(i + 1, n_after) - right(origin + offset);
    return rest * lower * from_high + of_beside;
  };
  const double middle = 0.5 * gap, there = condition(low, middle, middle, middle);
  const auto above = [&](double x) { return x == middle ? there : condition(low, x, gap - x, x); };
  const auto below = [&](double x) {
    return x == middle ? there : condition(poles.at[i], gap - x, x, -x);
  };
  if (there > 0.0) return {low, root_in(above, 0.0, middle)};
  return {poles.at[i], -root_in(below, 0.0, middle)};
}

/// The root above all poles, for a negative constant on the right.
inline SecularRoot root_above(const Poles& poles, double right) {
  const Eigen::Index n = poles.size() - 1;
  const double last = poles.at[n];
  const auto condition = [&](double x) {
    const double rest = (poles.weight.head(n) / (poles.at.head(n) - last - x)).sum();
    return (rest - right) * x - poles.weight[n];
  };
  return {last, root_in(condition, 0.0, -2.0 * poles.weight.sum() / right)};
}

}  // namespace subimpact
