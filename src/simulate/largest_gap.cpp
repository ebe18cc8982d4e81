#include "simulate/largest_gap.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "numerics/hermite.h"

namespace subimpact {
namespace {

// Steps are halved until the gap at the middle is that of the cubic, to this part of the largest
// gap.
constexpr double accuracy = 1e-5;
constexpr int most_halvings = 6;

// Whether the indentation may fall and rise again between the ends of a step.
bool may_turn(const IndentationStep& ends) {
  if (ends.rate0 < 0.0 && ends.rate1 >= 0.0) return true;
  if (ends.rate0 >= 0.0 && ends.rate1 < 0.0) return false;
  return ends.length() * std::abs(ends.rate0 + ends.rate1) >
         3.0 * std::abs(ends.lambda1 - ends.lambda0);
}

}  // namespace

void LargestGap::follow(const ObservedStep& step, const StruckBeam& beam, double& largest) {
  const IndentationStep& ends = step.indentation();
  largest = std::max(largest, beam.contact().residual_indentation() - ends.lambda1);
  if (step.ends().event_free) {
    look_into_flight(step, beam, largest);
  } else if (may_turn(ends)) {
    look_into(step, beam, ends, largest);
  }
}

void LargestGap::look_into(const ObservedStep& step, const StruckBeam& beam, IndentationStep part,
                           double& largest) {
  const double residual = beam.contact().residual_indentation();
  for (int n = 0;; ++n) {
    const HermiteCubic gap(residual - part.lambda0, -part.rate0, residual - part.lambda1,
                           -part.rate1, part.length());
    const std::optional<double> top = gap.maximum();
    if (!top || !(gap(*top) > largest)) return;
    if (!of_trajectory_ || n == most_halvings) {
      largest = gap(*top);
      return;
    }
    const double t = part.t0 + *top * part.length();
    step.state_at(t, state_);
    const double lambda = beam.indentation(state_), rate = beam.indentation_rate(state_);
    largest = std::max(largest, residual - lambda);
    if (std::abs(residual - lambda - gap(*top)) <= accuracy * largest) return;
    part = rate < 0.0 ? IndentationStep{t, part.t1, lambda, rate, part.lambda1, part.rate1}
                      : IndentationStep{part.t0, t, part.lambda0, part.rate0, lambda, rate};
  }
}

void LargestGap::look_into_flight(const ObservedStep& step, const StruckBeam& beam,
                                  double& largest) {
  const auto around = step.around_smallest();
  if (!around) return;
  const double residual = beam.contact().residual_indentation();
  IndentationStep part{};
  std::tie(part.t0, part.t1) = *around;
  const auto read = [&](double t, double& lambda, double& rate) {
    step.state_at(t, state_);
    lambda = beam.indentation(state_);
    rate = beam.indentation_rate(state_);
    largest = std::max(largest, residual - lambda);
  };
  read(part.t0, part.lambda0, part.rate0);
  read(part.t1, part.lambda1, part.rate1);
  look_into(step, beam, part, largest);
}

}  // namespace subimpact
