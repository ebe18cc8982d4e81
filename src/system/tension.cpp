#include "system/tension.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/lanes.h"

namespace subimpact {

Tension::Tension(BandedMatrix form, const Beam& beam, double limit)
    : form_(std::move(form)),
      stiffness_(beam.youngs_modulus * beam.area() / beam.length),
      limit_(limit),
      product_(form_.size()) {}

Tension::Response Tension::response(double square) const {
  const double elastic = stiffness_ * (0.5 * square - plastic_);
  const double tension = std::clamp(elastic, -limit_, limit_);
  const double flow = (elastic - tension) / stiffness_;
  return {tension, flow, flow == 0.0 ? 0.0 : limit_ * std::abs(flow)};
}

void Tension::add_to(std::span<double> forces, std::span<const double> unknowns) const {
  form_.multiply(unknowns, product_);
  const double tension = response(dot(product_.data(), unknowns.data(), product_.size())).tension;
  for (std::size_t i = 0; i < product_.size(); ++i) forces[i] -= tension * product_[i];
}

void Tension::add_rate_to(std::span<double> forces, std::span<const double> unknowns,
                          std::span<const double> velocities) const {
  form_.multiply(unknowns, product_);
  const Response now = response(dot(product_.data(), unknowns.data(), product_.size()));
  const double rate = dot(product_.data(), velocities.data(), product_.size());
  const double change = now.flow == 0.0 ? stiffness_ * rate : 0.0;
  for (std::size_t i = 0; i < product_.size(); ++i) forces[i] -= change * product_[i];
  form_.multiply(velocities, product_);
  for (std::size_t i = 0; i < product_.size(); ++i) forces[i] -= now.tension * product_[i];
}

Tension::Energies Tension::energies(std::span<const double> unknowns) const {
  const auto [tension, flow, work] = response(form_.quadratic_form(unknowns));
  return {0.5 * tension * tension / stiffness_, work_ + work};
}

void Tension::commit(std::span<const double> unknowns) {
  const Response now = response(form_.quadratic_form(unknowns));
  plastic_ += now.flow;
  work_ += now.work;
}

}  // namespace subimpact
