#include "system/flight/no_more_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/mesh/modes.h"
#include "numerics/lanes.h"

namespace subimpact {

namespace {

// Modes whose motion is followed; what they leave is bounded by its energy. Of beams that may yield
// only the rigid ones are needed.
constexpr std::size_t n_followed = 12;
constexpr std::size_t most_rigid = 2;
// Relative margin of the bounds for rounding.
constexpr double rounding = 1e-5;

}  // namespace

NoMoreContact::NoMoreContact(const StruckBeam& beam, const Beam& material, double first_period)
    : n_(beam.mesh().n_unknowns()), accounts_(beam) {
  const BeamMesh& mesh = beam.mesh();
  const SectionField& sections = beam.sections();
  const auto motion = slow_motion(mesh, sections.stiffness(), first_period,
                                  sections.can_yield() ? most_rigid : n_followed);
  if (!motion) return;
  compliance_ = compliance_of_rest_ = mesh.struck_point()(motion->response);
  std::vector<double> frequencies{0.0}, shares{1.0};
  for (std::size_t k = 0; k < motion->size(); ++k) {
    const double omega = motion->frequencies[k];
    const double share = mesh.struck_point()(motion->shapes[k]);
    modes_.push_back({omega, share, motion->shapes[k], std::vector<double>(n_)});
    mesh.mass().multiply(motion->shapes[k], modes_.back().inertia);
    if (omega == 0.0) continue;
    frequencies.push_back(omega);
    shares.push_back(-share);
    compliance_of_rest_ -= share * share / (omega * omega);
  }
  compliance_of_rest_ = std::max(compliance_of_rest_, 0.0) + rounding * compliance_;
  // A tension has no natural modes; its energy is in the bound.
  if (!sections.can_yield()) {
    const bool has_modes = beam.tension() == nullptr && frequencies.size() > 1;
    if (has_modes) horizon_.emplace(std::move(frequencies), std::move(shares));
    return;
  }
  take_plastic_compliance(beam, motion->response, material);
}

void NoMoreContact::take_plastic_compliance(const StruckBeam& beam,
                                            std::span<const double> response,
                                            const Beam& material) {
  const BeamMesh& mesh = beam.mesh();
  std::vector<double> kbar(mesh.n_sections());
  mesh.curvatures(response, kbar);
  double largest = 0.0;
  for (std::size_t i = 0; i < kbar.size(); ++i) {
    largest = std::max(largest, std::abs(kbar[i]));
    bar_.push_back(mesh.section_weights()[i] * kbar[i]);
  }
  plastic_compliance_ = largest * material.youngs_modulus * 0.5 * material.height() /
                        material.yield_stress * beam.sections().law().fibres().extent();
}

bool NoMoreContact::allow_loads(const StruckBeam& beam) {
  const Loads& loads = beam.loads();
  if (loads.is_empty()) return true;
  if (loads.will_change()) return false;
  if (loads.start() == loads_begun_) return loads_allow_;
  loads_begun_ = loads.start();
  loads_allow_ = false;
  about_.clear();
  std::vector<double> rest(loads.value().begin(), loads.value().end());
  const double size = std::sqrt(dot(rest.data(), rest.data(), n_));
  double apart = -beam.striker_load();  // acceleration of the struck point less that of the striker
  bool is_held = true;
  for (const Mode& mode : modes_) {
    if (mode.frequency != 0.0) continue;
    is_held = false;
    const double amount = dot(mode.shape.data(), loads.value().data(), n_);
    apart += mode.share * amount;
    for (std::size_t i = 0; i < n_; ++i) rest[i] -= amount * mode.inertia[i];
  }
  if (apart < -rounding * std::abs(beam.striker_load())) return false;
  if (std::sqrt(dot(rest.data(), rest.data(), n_)) > rounding * size) {
    if (!is_held || beam.sections().can_yield() || beam.tension() != nullptr) return false;
    const auto at_rest = beam.equilibrium();
    if (!at_rest) return false;
    about_ = *at_rest;
  }
  return loads_allow_ = true;
}

bool NoMoreContact::is_proven(const StruckBeam& beam, const State& y) {
  if (modes_.empty() || !beam.supports().empty() || beam.contact().is_closed()) return false;
  if (!allow_loads(beam)) return false;
  std::vector<double> w(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(n_));
  const std::span<const double> v{y.data() + n_ + 1, n_};
  const Energies energies = accounts_.energies(y);
  // The striker against the rigid motion; the modes that follow.
  std::vector<double> z{y[n_]}, rates{y.back()};
  double energy = energies.beam_kinetic + energies.bending_elastic;
  if (!about_.empty()) {
    const std::span<const double> load = beam.loads().value();
    energy += 0.5 * dot(load.data(), about_.data(), n_) - dot(load.data(), w.data(), n_);
    for (std::size_t i = 0; i < n_; ++i) w[i] -= about_[i];
    z[0] -= beam.mesh().struck_point()(about_);
  }
  double energy_of_modes = 0.0;
  for (const Mode& mode : modes_) {
    const double amount = dot(mode.inertia.data(), w.data(), n_);
    const double rate = dot(mode.inertia.data(), v.data(), n_);
    if (mode.frequency == 0.0) {
      z[0] -= mode.share * amount;
      rates[0] -= mode.share * rate;
      energy -= 0.5 * rate * rate;
    } else {
      z.push_back(amount);
      rates.push_back(rate);
      energy_of_modes += 0.5 * (rate * rate + std::pow(mode.frequency * amount, 2));
    }
  }
  if (!(rates[0] <= 0.0)) return false;
  if (beam.damping().mass > 0.0 && y.back() > 0.0) return false;  // the rigid motion decays
  energy = std::max(energy, 0.0);

  double plastic = 0.0;
  if (!bar_.empty()) {
    const auto [curvatures, moments] = accounts_.bending(y);
    for (std::size_t i = 0; i < bar_.size(); ++i) {
      plastic += bar_[i] * (beam.sections().stiffness() * curvatures[i] - moments[i]);
    }
  }
  const double a = plastic_compliance_;
  const double bound = 2.0 * a * a * energy > compliance_ ? a * energy + compliance_ / (2.0 * a)
                                                          : std::sqrt(2.0 * compliance_ * energy);
  const double residual = beam.contact().residual_indentation();
  if (z[0] - plastic + (1.0 + rounding) * bound < residual) return true;
  if (beam.depends_on_velocity() || !horizon_ || !(rates[0] < 0.0)) return false;
  const double of_rest =
      std::sqrt(2.0 * compliance_of_rest_ * std::max(energy - energy_of_modes, rounding * energy));
  return stays_below(residual - of_rest, z, rates);
}

bool NoMoreContact::stays_below(double limit, std::span<const double> z,
                                std::span<const double> rates) {
  double farthest = 0.0;  // that the modes reach
  std::size_t k = 1;
  for (const Mode& mode : modes_) {
    if (mode.frequency == 0.0) continue;
    farthest += std::abs(mode.share) * std::hypot(z[k], rates[k] / mode.frequency);
    ++k;
  }
  const double needed = std::max(0.0, z[0] + farthest - limit) / -rates[0];
  const double lowest = -std::numeric_limits<double>::infinity();
  return horizon_->from(z, rates, {&lowest, 1}, {&limit, 1}, needed) >= needed;
}

}  // namespace subimpact
