#include "system/loads.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "numerics/lanes.h"

namespace subimpact {

Loads::Loads(const BeamMesh& mesh, const Beam& beam, double gravity)
    : gravity_(gravity), length_(beam.length) {
  if (gravity == 0.0 && !beam.has_loads()) return;
  const std::size_t n = mesh.n_unknowns();
  const double acceleration = gravity + beam.load / beam.mass_per_length();
  uniform_force_ = acceleration * mesh.beam_mass();
  for (const double mass : mesh.momentum_functional()) uniform_.push_back(acceleration * mass);
  for (const PointForce& force : beam.forces) {
    const double x = force.position * beam.length;
    const auto displacement = mesh.displacement_at(mesh.symmetric() ? std::min(x, length_ - x) : x);
    if (!displacement) throw std::invalid_argument("loads: a mesh without displacement_at()");
    points_.push_back({x, std::vector<double>(n, 0.0), force.table});
    displacement->add_to(points_.back().functional, 1.0);
  }
  begin_piece(0.0);
}

void Loads::begin_piece(double t) {
  if (uniform_.empty()) return;
  if (!value_.empty()) impulse_before_ = impulse(t);
  value_ = uniform_;
  rate_.assign(uniform_.size(), 0.0);
  varies_ = false;
  start_ = t;
  next_corner_ = std::numeric_limits<double>::infinity();
  for (Point& point : points_) {
    const auto& table = point.table;
    // A corner within the rounding of the table's times is passed at once, as a jump is.
    const double now = t + 4.0 * std::numeric_limits<double>::epsilon() * table.back().first;
    while (point.next < table.size() && table[point.next].first <= now) ++point.next;
    const bool last = point.next == table.size();
    if (!last) next_corner_ = std::min(next_corner_, table[point.next].first);
    point.rate = 0.0;
    point.value = table[last ? point.next - 1 : point.next].second;
    if (point.next > 0 && !last) {
      const auto [t0, f0] = table[point.next - 1];
      const auto [t1, f1] = table[point.next];
      point.rate = (f1 - f0) / (t1 - t0);
      point.value = f0 + point.rate * (t - t0);
    }
    varies_ = varies_ || point.rate != 0.0;
    for (std::size_t i = 0; i < value_.size(); ++i) {
      value_[i] += point.value * point.functional[i];
      rate_[i] += point.rate * point.functional[i];
    }
  }
}

void Loads::add_to(std::span<double> forces, double t) const {
  const double since = t - start_;
  for (std::size_t i = 0; i < value_.size(); ++i) forces[i] += value_[i] + since * rate_[i];
}

double Loads::potential(std::span<const double> unknowns, double t) const {
  const std::size_t n = value_.size();
  return dot(value_.data(), unknowns.data(), n) +
         (varies_ ? (t - start_) * power_of_change(unknowns) : 0.0);
}

double Loads::power_of_change(std::span<const double> unknowns) const {
  return dot(rate_.data(), unknowns.data(), rate_.size());
}

Loads::Resultant Loads::resultant(double t) const {
  Resultant sum{uniform_force_, 0.5 * length_ * uniform_force_};
  for (const Point& point : points_) {
    const double force = point.value + (t - start_) * point.rate;
    sum.force += force;
    sum.moment += force * point.x;
  }
  return sum;
}

double Loads::impulse(double t) const {
  return impulse_before_ + 0.5 * (t - start_) * (resultant(start_).force + resultant(t).force);
}

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
