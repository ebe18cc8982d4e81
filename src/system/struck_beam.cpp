#include "system/struck_beam.h"

#include <limits>
#include <utility>

namespace subimpact {

StruckBeam::StruckBeam(StruckBeamParts parts)
    : mesh_(std::move(parts.mesh)),
      sections_(std::move(parts.sections)),
      contact_(std::move(parts.contact_law), parts.contact_damping, parts.restitution_velocity),
      mass_solver_(std::move(parts.mass_solver)),
      n_(mesh_->n_unknowns()),
      striker_mass_(parts.striker_mass),
      striker_velocity_(parts.striker_velocity),
      outer_stiffness_(parts.outer_stiffness),
      loads_(std::move(parts.loads)),
      tension_(std::move(parts.tension)),
      damping_(parts.damping),
      depends_on_velocity_(parts.contact_damping > 0.0 || !parts.damping.is_none()),
      highest_frequency_(mesh_->highest_frequency(sections_.stiffness())),
      curvatures_(mesh_->n_sections()),
      moments_(mesh_->n_sections()),
      trial_(n_ + 1),
      committed_(mesh_->n_sections()) {
  const auto [stiffness, exponent] = contact_.law().scales();
  const double velocity = parts.velocity_scale > 0.0 ? parts.velocity_scale : striker_velocity_;
  const double mass = has_stop() ? mesh_->beam_mass() : striker_mass_;
  const double contact_time =
      std::pow(mass / (stiffness * std::pow(velocity, exponent - 1.0)), 1.0 / (exponent + 1.0));
  scales_ = {velocity * contact_time, velocity};
  if (!sections_.can_yield()) use_modes();
  if (parts.on_supports == nullptr) return;
  supports_ = lifting_supports(*mesh_, *parts.on_supports, scales_.position);
  double squares = highest_frequency_ * highest_frequency_;
  for (const LiftingSupport& support : supports_) {
    depends_on_velocity_ = depends_on_velocity_ || support.contact.is_damped();
    std::vector<double> response(n_, 0.0);
    support.approach.add_to(response, 1.0);
    mass_solver_.solve(response);
    squares += support.copies * support.stiffness() * support.approach(response);
  }
  highest_frequency_ = std::sqrt(squares);
}

void StruckBeam::settle_on_supports(const State& y) {
  if (supports_.empty()) return;
  std::vector<double> under_loads(n_ + 1), struck(n_, 0.0);
  acceleration_at(y, under_loads);
  mesh_->struck_point().add_to(struck, 1.0);
  mass_solver_.solve(struck);
  for (LiftingSupport& support : supports_) {
    const double depth = support.indentation(beam_positions(y));
    const double of_loads = support.approach({under_loads.data(), n_});
    const bool is_still = depth == 0.0 && support.approach(beam_velocities(y)) == 0.0;
    support.contact.follow(!is_still         ? depth
                           : of_loads != 0.0 ? of_loads
                                             : support.approach(struck));
  }
}

void StruckBeam::use_modes() {
  modal_stiffness_ = mesh_->modal_stiffness();
  if (modal_stiffness_.empty()) return;
  modal_loads_.assign(n_, 0.0);
  mesh_->struck_point().add_to(modal_loads_, 1.0);
  for (std::size_t i = 0; i < n_; ++i) {
    const double mass = mesh_->mass().at(i, i);
    modal_loads_[i] /= mass;
    modal_frequencies_squared_.push_back(modal_stiffness_[i] / mass);
    const double squared = modal_frequencies_squared_.back();
    modal_damping_.push_back(2.0 * damping_.ratio * std::sqrt(squared) + damping_.mass +
                             damping_.stiffness * squared);
  }
}

void StruckBeam::set_start(State start) {
  start_ = std::move(start);
  potential_before_ = 0.0;
  if (!loads_.is_empty()) potential_before_ = load_potential(start_, loads_.start());
}

double StruckBeam::load_potential(const State& y, double t) const {
  const double of_striker = has_stop() ? 0.0 : striker_mass_ * loads_.gravity() * y[n_];
  return loads_.potential(beam_positions(y), t) + of_striker;
}

void StruckBeam::begin_loads(const State& y, double t) {
  const double before = load_potential(y, t);
  loads_.begin_piece(t);
  potential_before_ += load_potential(y, t) - before;
}

State StruckBeam::initial_state() const {
  if (!start_.empty()) return start_;
  State y(2 * n_positions(), 0.0);
  y.back() = striker_velocity_;
  return y;
}

State StruckBeam::state_before_touch(double time) const {
  State y = initial_state();
  y[n_] -= striker_velocity_ * time;
  return y;
}

void StruckBeam::bend(std::span<const double> unknowns, std::span<double> forces) {
  if (!modal_stiffness_.empty()) {
    for (std::size_t i = 0; i < n_; ++i) forces[i] = -modal_stiffness_[i] * unknowns[i];
    return;
  }
  mesh_->curvatures(unknowns, curvatures_);
  if (section_evaluation_ == Evaluation::smooth) {
    sections_.smooth_moments(curvatures_, moments_);
  } else {
    sections_.moments(curvatures_, moments_, &outside_);
  }
  mesh_->internal_forces(unknowns, moments_, forces);
  if (tension_) tension_->add_to(forces, unknowns);
}

void StruckBeam::acceleration(std::span<const double> positions, std::span<double> result) {
  const auto unknowns = positions.first(n_);
  const double contact = contact_.force(positions[n_] - mesh_->struck_point()(unknowns));
  respond(unknowns, {}, contact, result);
}

void StruckBeam::acceleration_at(std::span<const double> y, std::span<double> result) {
  if (!depends_on_velocity_) return acceleration(y.first(n_ + 1), result);
  respond(y.first(n_), beam_velocities(y), contact_.force(indentation(y), indentation_rate(y)),
          result);
}

void StruckBeam::respond(std::span<const double> unknowns, std::span<const double> velocities,
                         double contact, std::span<double> result) {
  ++n_accelerations_;
  const auto forces = result.first(n_);
  result[n_] = -contact / striker_mass_ + striker_load();
  if (!modal_frequencies_squared_.empty()) {
    const double* q = unknowns.data();
    const double* squared = modal_frequencies_squared_.data();
    const double* load = modal_loads_.data();
    double* a = forces.data();
#pragma GCC ivdep
    for (std::size_t i = 0; i < n_; ++i) a[i] = contact * load[i] - squared[i] * q[i];
    for (std::size_t i = 0; i < velocities.size(); ++i) a[i] -= modal_damping_[i] * velocities[i];
    const double since = time_ - loads_.start();
    for (std::size_t i = 0; i < loads_.value().size(); ++i) {
      a[i] += (loads_.value()[i] + since * loads_.rate()[i]) / mesh_->mass().at(i, i);
    }
    return;
  }
  bend(unknowns, forces);
  if (!velocities.empty() && damping_.stiffness > 0.0) add_stiffness_damping(velocities, forces);
  mesh_->struck_point().add_to(forces, contact);
  if (!supports_.empty()) add_support_forces(unknowns, velocities, forces);
  if (!loads_.is_empty()) loads_.add_to(forces, time_);
  mass_solver_.solve(forces);
  for (std::size_t i = 0; i < velocities.size(); ++i) forces[i] -= damping_.mass * velocities[i];
}

void StruckBeam::add_support_forces(std::span<const double> unknowns,
                                    std::span<const double> velocities,
                                    std::span<double> forces) const {
  for (const LiftingSupport& support : supports_) {
    if (!support.contact.exerts_force()) continue;
    const double depth = support.indentation(unknowns);
    const double rate = velocities.empty() ? 0.0 : support.approach(velocities);
    support.approach.add_to(forces, -support.copies * support.contact.force(depth, rate));
  }
}

void StruckBeam::add_stiffness_damping(std::span<const double> velocities,
                                       std::span<double> forces) {
  mesh_->curvatures(velocities, curvatures_);
  for (std::size_t i = 0; i < moments_.size(); ++i) {
    moments_[i] = sections_.stiffness() * curvatures_[i];
  }
  damping_forces_.resize(n_);
  mesh_->internal_forces(velocities, moments_, damping_forces_);
  for (std::size_t i = 0; i < n_; ++i) forces[i] += damping_.stiffness * damping_forces_[i];
}

void StruckBeam::add_damping(std::span<const double> velocities, std::span<double> forces) {
  if (!modal_damping_.empty()) {
    for (std::size_t i = 0; i < n_; ++i) {
      forces[i] -= modal_damping_[i] * mesh_->mass().at(i, i) * velocities[i];
    }
    return;
  }
  if (damping_.stiffness > 0.0) add_stiffness_damping(velocities, forces);
  if (damping_.mass > 0.0) {
    damping_forces_.resize(n_);
    mesh_->mass().multiply(velocities, damping_forces_);
    for (std::size_t i = 0; i < n_; ++i) forces[i] -= damping_.mass * damping_forces_[i];
  }
}

double StruckBeam::damping_power(std::span<const double> velocities) {
  if (damping_.is_none()) return 0.0;
  const std::span<double> forces(trial_.data(), n_);
  std::fill(forces.begin(), forces.end(), 0.0);
  add_damping(velocities, forces);
  double power = 0.0;
  for (std::size_t i = 0; i < n_; ++i) power -= forces[i] * velocities[i];
  return power;
}

void StruckBeam::force(std::span<const double> y, std::span<double> result) {
  const auto forces = result.first(n_);
  ++n_forces_;
  bend(y.first(n_), forces);
  if (!damping_.is_none()) add_damping(beam_velocities(y), forces);
  const double contact = contact_force(y);
  mesh_->struck_point().add_to(forces, contact);
  if (!supports_.empty()) add_support_forces(y.first(n_), beam_velocities(y), forces);
  if (!loads_.is_empty()) loads_.add_to(forces, time_);
  result[n_] = has_stop() ? 0.0 : striker_mass_ * striker_load() - contact;
}

void StruckBeam::stiffness_entries(std::span<const double> y, std::span<double> values) {
  const auto unknowns = y.first(n_);
  mesh_->curvatures(unknowns, curvatures_);
  for (std::size_t i = 0; i < moments_.size(); ++i) {
    moments_[i] = section_evaluation_ == Evaluation::smooth
                      ? sections_.smooth_tangent(i, curvatures_[i])
                      : sections_.tangent(i, curvatures_[i]);
  }
  // What a change of the tension adds is of rank one, not banded, and left out.
  const double tension = tension_ ? tension_->at(unknowns) : 0.0;
  jacobian().stiffness_entries(moments_, values, tension, tension_ ? &tension_->form() : nullptr);
  for (std::size_t i = 0; i < n_contacts(); ++i) {
    const double rate = depends_on_velocity_ ? indentation_rate(y, i) : 0.0;
    jacobian().add_contact(i, contact(i).slope(indentation(y, i), rate), values);
  }
}

void StruckBeam::damping_entries(std::span<const double> y, std::span<double> values) {
  std::fill(values.begin(), values.end(), 0.0);
  if (damping_.stiffness > 0.0) {
    std::fill(moments_.begin(), moments_.end(), sections_.stiffness());
    jacobian().stiffness_entries(moments_, values);
    for (double& value : values) value *= damping_.stiffness;
  }
  for (std::size_t i = 0; i < n_contacts(); ++i) {
    jacobian().add_contact(i, contact(i).rate_slope(indentation(y, i)), values);
  }
  if (damping_.mass == 0.0) return;
  std::vector<double> mass(values.size());
  jacobian().mass_entries(mass);
  mass.back() = 0.0;  // the striker's
  for (std::size_t k = 0; k < values.size(); ++k) values[k] += damping_.mass * mass[k];
}

double StruckBeam::displacement_rounding(std::span<const double> y, std::size_t contact) const {
  const auto unknowns = beam_positions(y);
  const double size = contact == 0 ? std::abs(y[n_]) + std::abs(mesh_->struck_point()(unknowns))
                                   : std::abs(supports_[contact - 1].approach(unknowns)) +
                                         supports_[contact - 1].gap;
  return 8.0 * std::numeric_limits<double>::epsilon() * size;
}

void StruckBeam::read_motion(const State& y, SectionMotion& motion) const {
  mesh_->curvatures(beam_positions(y), motion.curvatures);
  mesh_->curvatures(beam_velocities(y), motion.rates);
}

EventValue StruckBeam::evaluate(const EventFunction& function, const State& y) {
  const std::size_t i = function.contact;
  const double rate = indentation_rate(y, i);
  const EventValue at = contact(i).event_function(function, indentation(y, i), rate);
  if (!function.of_rate()) return at;
  acceleration_at(y, trial_);
  const std::span<const double> of_beam(trial_.data(), n_);
  const double second =
      i == 0 ? trial_[n_] - mesh_->struck_point()(of_beam) : supports_[i - 1].approach(of_beam);
  return {at.value, function.kind == EventKind::contact_begins ? second : -second};
}

bool StruckBeam::commit(const State& y) {
  if (contact_.loads()) contact_.commit(indentation(y));
  if (tension_) tension_->commit(beam_positions(y));
  if (!sections_.can_yield()) return false;
  if (section_evaluation_ == Evaluation::smooth) {
    read_motion(y, committed_);
    return count_flows(sections_.commit(committed_.curvatures, committed_.rates));
  }
  mesh_->curvatures(beam_positions(y), curvatures_);
  return count_flows(sections_.commit(curvatures_));
}

bool StruckBeam::commit_evaluated(const State& y) {
  if (section_evaluation_ == Evaluation::smooth) return commit(y);
  if (contact_.loads()) contact_.commit(indentation(y));
  if (tension_) tension_->commit(beam_positions(y));
  return count_flows(sections_.commit(outside_));
}

BeamJacobian& StruckBeam::jacobian() const {
  if (!jacobian_) jacobian_ = std::make_unique<BeamJacobian>(*mesh_, striker_mass_, supports_);
  return *jacobian_;
}

}  // namespace subimpact
