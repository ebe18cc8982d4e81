#include "system/tension.h"

#include <algorithm>
#include <cmath>

#include "numerics/lanes.h"

namespace subimpact {

Tension::Tension(BandedMatrix form, const Beam& beam, double limit)
    : form_(std::move(form)),
      stiffness_(beam.youngs_modulus * beam.area() / beam.length),
      limit_(limit),
      product_(form_.size()) {}

double Tension::at(std::span<const double> unknowns) const {
  return std::clamp(trial(form_.quadratic_form(unknowns)), -limit_, limit_);
}

void Tension::add_to(std::span<double> forces, std::span<const double> unknowns) {
  form_.multiply(unknowns, product_);
  const double square = dot(product_.data(), unknowns.data(), product_.size());
  const double tension = std::clamp(trial(square), -limit_, limit_);
  for (std::size_t i = 0; i < product_.size(); ++i) forces[i] -= tension * product_[i];
}

Tension::Energies Tension::energies(std::span<const double> unknowns) const {
  const double beyond = trial(form_.quadratic_form(unknowns));
  const double tension = std::clamp(beyond, -limit_, limit_);
  const double flow = std::abs(beyond - tension) / stiffness_;
  return {0.5 * tension * tension / stiffness_, work_ + (flow > 0.0 ? limit_ * flow : 0.0)};
}

void Tension::commit(std::span<const double> unknowns) {
  const double beyond = trial(form_.quadratic_form(unknowns));
  const double flow = (beyond - std::clamp(beyond, -limit_, limit_)) / stiffness_;
  if (flow == 0.0) return;
  plastic_ += flow;
  work_ += limit_ * std::abs(flow);
}

}  // namespace subimpact
