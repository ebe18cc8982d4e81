#include "simulate/force_quadrature.h"

#include <algorithm>
#include <cmath>

#include "numerics/gauss.h"
#include "numerics/hermite.h"

namespace subimpact {
namespace {

// Halvings of a step: each takes the error down 16 times.
constexpr int most_halvings = 8;

double fifth_power(double h) { return h * h * h * h * h; }

}  // namespace

double ForceQuadrature::between(const Node& a, const Node& b, const StruckBeam& beam) {
  const double h = b.time - a.time;
  const HermiteCubic indentation(a.indentation, a.rate, b.indentation, b.rate, h);
  const ContactState& contact = beam.contact();
  const bool damped = contact.is_damped();
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double s = gauss<3>.points[i];
    sum += gauss<3>.weights[i] * (damped ? contact.force(indentation(s), indentation.slope(s) / h)
                                         : contact.force(indentation(s)));
  }
  return h * sum;
}

double ForceQuadrature::halved(const Node& a, const Node& b, double whole, const ObservedStep& step,
                               const StruckBeam& beam, int depth) {
  const double middle_time = 0.5 * (a.time + b.time);
  step.state_at(middle_time, state_);
  const Node middle = node(middle_time, state_, beam);
  largest_indentation_ = std::max(largest_indentation_, middle.indentation);
  const double first = between(a, middle, beam);
  const double second = between(middle, b, beam);
  const double correction = (first + second - whole) / 15.0;
  if (!(std::abs(correction) > tolerance_) || depth == most_halvings) {
    return first + second + correction;
  }
  return halved(a, middle, first, step, beam, depth + 1) +
         halved(middle, b, second, step, beam, depth + 1);
}

double ForceQuadrature::over(const ObservedStep& step, const StruckBeam& beam) {
  largest_indentation_ = 0.0;
  if (!(step.length() > 0.0)) return 0.0;  // an event at the very start of a step
  const auto [a, b] = ends_of(step);
  const double h = step.length();
  const double whole = between(a, b, beam);
  double constant = 0.0;
  if (previous_) {
    const double both = h + previous_->length;
    const double change = previous_->integral + whole - between(previous_->start, b, beam);
    constant = change / (fifth_power(both) - fifth_power(h) - fifth_power(previous_->length));
  }
  const bool trusted = previous_ && std::abs(constant) * fifth_power(h) <= tolerance_;
  previous_ = Step{a, h, whole};
  if (trusted || !(std::abs(whole) > tolerance_)) return whole + constant * fifth_power(h);
  return halved(a, b, whole, step, beam, 1);
}

double ForceQuadrature::roughly_over(const ObservedStep& step, const StruckBeam& beam) const {
  const auto [a, b] = ends_of(step);
  return between(a, b, beam);
}

}  // namespace subimpact
