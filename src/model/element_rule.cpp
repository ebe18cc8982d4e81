#include "model/element_rule.h"

#include <cmath>
#include <stdexcept>

#include "numerics/bracketed_root.h"
#include "numerics/gauss.h"

namespace subimpact {
namespace {

// In eta = 2 s - 1, from the points up to the middle, which have the most digits.
template <std::size_t n>
ElementRule gauss_in_eta() {
  ElementRule rule;
  for (std::size_t i = 0; i < n; ++i) {
    rule.points.push_back(2 * i < n ? 2.0 * gauss<n>.points[i] - 1.0
                                    : 1.0 - 2.0 * gauss<n>.points[n - 1 - i]);
    rule.weights.push_back(gauss<n>.weights[i]);
    rule.of_curvature.push_back({1.0, rule.points.back()});
  }
  return rule;
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
  const double too_near = 1e-3;  // too much of the peak
  const double too_far = 0.2;    // too little, as at Gauss' 0.211
  const auto excess = [](double near) {
    const Pair pair = pair_with(near);
    return pair.near_weight / std::sqrt(pair.near) + pair.far_weight / std::sqrt(pair.far) - 2.0;
  };
  return pair_with(root_in(excess, too_near, too_far));
}

}  // namespace

ElementRule gauss_rule(std::size_t n) {
  switch (n) {
    case 2:
      return gauss_in_eta<2>();
    case 3:
      return gauss_in_eta<3>();
    case 4:
      return gauss_in_eta<4>();
    default:
      throw std::invalid_argument("hermite mesh: 2, 3 or 4 sections per element");
  }
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
  // mean = sum w kappa and half = 3 sum w eta kappa is the condition on the moments; solved for the
  // two kappa.
  const auto& eta = rule.points;
  const auto& w = rule.weights;
  const double apart = eta[1] - eta[0];
  rule.of_curvature = {{eta[1] / (w[0] * apart), -1.0 / (3.0 * w[0] * apart)},
                       {-eta[0] / (w[1] * apart), 1.0 / (3.0 * w[1] * apart)}};
  return rule;
}

}  // namespace subimpact
