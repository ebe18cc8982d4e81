#include "model/element_rule.h"

#include <cmath>
#include <stdexcept>

namespace subimpact {
namespace {

ElementRule gauss_points(std::size_t n) {
  switch (n) {
    case 2: {
      const double x = std::sqrt(1.0 / 3.0);
      return {{-x, x}, {0.5, 0.5}, {}};
    }
    case 3: {
      const double x = std::sqrt(0.6);
      return {{-x, 0.0, x}, {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0}, {}};
    }
    case 4: {
      const double root = std::sqrt(1.2);
      const double inner = std::sqrt((3.0 - 2.0 * root) / 7.0);
      const double outer = std::sqrt((3.0 + 2.0 * root) / 7.0);
      const double part = std::sqrt(30.0) / 72.0;
      return {
          {-outer, -inner, inner, outer}, {0.25 - part, 0.25 + part, 0.25 + part, 0.25 - part}, {}};
    }
    default:
      throw std::invalid_argument("hermite mesh: 2, 3 or 4 sections an element");
  }
}

// Two points and weights at distances x (shares of the element) from a hinge that, with the hinge's
// own weight at 0, integrate 1, x and x^2.
struct Pair {
  double near, far, near_weight, far_weight;
};

Pair pair_with(double near) {
  const double weight = 1.0 - hinge_share;
  const double far = (1.0 / 3.0 - 0.5 * near) / (0.5 - weight * near);
  const double near_weight = (weight * far - 0.5) / (far - near);
  return {near, far, near_weight, weight - near_weight};
}

// The pair that integrates x^(-1/2), too.
Pair pair_beside_hinge() {
  double low = 1e-3;  // the nearer point too near: too much of the peak
  double high = 0.2;  // Gauss: 0.211, too little
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const Pair pair = pair_with(middle);
    const double integral =
        pair.near_weight / std::sqrt(pair.near) + pair.far_weight / std::sqrt(pair.far);
    (integral > 2.0 ? low : high) = middle;
  }
  return pair_with(0.5 * (low + high));
}

}  // namespace

ElementRule gauss_rule(std::size_t n) {
  ElementRule rule = gauss_points(n);
  for (const double eta : rule.points) rule.of_curvature.push_back({1.0, eta});
  return rule;
}

ElementRule rule_beside_hinges(bool at_start, bool at_end) {
  ElementRule rule;
  if (at_start && at_end) {
    const double weight = 0.5 - hinge_share;
    const double eta = std::sqrt((1.0 / 6.0 - hinge_share) / weight);
    rule = {{-eta, eta}, {weight, weight}, {}};
  } else {
    static const Pair pair = pair_beside_hinge();
    const double near = 1.0 - 2.0 * pair.near;
    const double far = 1.0 - 2.0 * pair.far;
    if (at_start) {
      rule = {{-near, -far}, {pair.near_weight, pair.far_weight}, {}};
    } else {
      rule = {{far, near}, {pair.far_weight, pair.near_weight}, {}};
    }
  }
  // mean = sum w kappa and half = 3 sum w eta kappa is what the moments' condition says; solved for
  // the two kappa.
  const auto& eta = rule.points;
  const auto& w = rule.weights;
  const double apart = eta[1] - eta[0];
  rule.of_curvature = {{eta[1] / (w[0] * apart), -1.0 / (3.0 * w[0] * apart)},
                       {-eta[0] / (w[1] * apart), 1.0 / (3.0 * w[1] * apart)}};
  return rule;
}

}  // namespace subimpact
