#include "system/struck_beam.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace subimpact {

StruckBeam::StruckBeam(StruckBeamParts parts)
    : mesh_(std::move(parts.mesh)),
      sections_(std::move(parts.sections)),
      contact_(std::move(parts.contact_law)),
      mass_solver_(std::move(parts.mass_solver)),
      n_(mesh_->n_unknowns()),
      striker_mass_(parts.striker_mass),
      striker_velocity_(parts.striker_velocity),
      outer_stiffness_(parts.outer_stiffness),
      shears_(mesh_->shears()),
      highest_frequency_(mesh_->highest_frequency(sections_.stiffness())),
      curvatures_(mesh_->n_sections()),
      moments_(mesh_->n_sections()),
      trial_(n_ + 1),
      committed_(mesh_->n_sections()) {
  const auto [stiffness, exponent] = contact_.law().scales();
  const double contact_time =
      std::pow(striker_mass_ / (stiffness * std::pow(striker_velocity_, exponent - 1.0)),
               1.0 / (exponent + 1.0));
  scales_ = {striker_velocity_ * contact_time, striker_velocity_};
  if (!sections_.can_yield()) use_modes();
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
  }
}

State StruckBeam::initial_state() const {
  State y(2 * n_positions(), 0.0);
  y.back() = striker_velocity_;
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
  mesh_->bending_forces(moments_, forces);
  if (shears_) mesh_->add_shear_forces(unknowns, forces);
}

void StruckBeam::acceleration(std::span<const double> positions, std::span<double> result) {
  ++n_accelerations_;
  const auto unknowns = positions.first(n_);
  const auto forces = result.first(n_);
  const double contact = contact_.force(positions[n_] - mesh_->struck_point()(unknowns));
  if (!modal_frequencies_squared_.empty()) {
    result[n_] = -contact / striker_mass_;
    const double* q = unknowns.data();
    const double* squared = modal_frequencies_squared_.data();
    const double* load = modal_loads_.data();
    double* a = forces.data();
#pragma GCC ivdep
    for (std::size_t i = 0; i < n_; ++i) a[i] = contact * load[i] - squared[i] * q[i];
    return;
  }
  bend(unknowns, forces);
  mesh_->struck_point().add_to(forces, contact);
  mass_solver_->solve(forces);
  result[n_] = -contact / striker_mass_;
}

void StruckBeam::force(std::span<const double> positions, Part part, std::span<double> result) {
  const auto unknowns = positions.first(n_);
  const auto forces = result.first(n_);
  if (part == Part::rest) {
    std::fill(forces.begin(), forces.end(), 0.0);
  } else {
    ++n_forces_;
    bend(unknowns, forces);
  }
  result[n_] = 0.0;
  if (part == Part::stiff) return;
  const double contact = contact_.force(positions[n_] - mesh_->struck_point()(unknowns));
  mesh_->struck_point().add_to(forces, contact);
  result[n_] = -contact;
}

void StruckBeam::stiffness_entries(std::span<const double> positions, Part part,
                                   std::span<double> values) {
  const auto unknowns = positions.first(n_);
  std::fill(moments_.begin(), moments_.end(), 0.0);
  if (part != Part::rest) {
    mesh_->curvatures(unknowns, curvatures_);
    for (std::size_t i = 0; i < moments_.size(); ++i) {
      moments_[i] = section_evaluation_ == Evaluation::smooth
                        ? sections_.smooth_tangent(i, curvatures_[i])
                        : sections_.tangent(i, curvatures_[i]);
    }
  }
  const double slope =
      part == Part::stiff ? 0.0 : contact_.slope(positions[n_] - mesh_->struck_point()(unknowns));
  jacobian().stiffness_entries(moments_, slope, values);
}

double StruckBeam::indentation(std::span<const double> y) const {
  return y[n_] - mesh_->struck_point()(beam_positions(y));
}

double StruckBeam::indentation_rate(std::span<const double> y) const {
  return y.back() - mesh_->struck_point()(beam_velocities(y));
}

double StruckBeam::displacement_rounding(std::span<const double> y) const {
  const double size = std::abs(y[n_]) + std::abs(mesh_->struck_point()(beam_positions(y)));
  return 8.0 * std::numeric_limits<double>::epsilon() * size;
}

void StruckBeam::read_motion(const State& y, SectionMotion& motion) const {
  mesh_->curvatures(beam_positions(y), motion.curvatures);
  mesh_->curvatures(beam_velocities(y), motion.rates);
}

EventValue StruckBeam::evaluate(const EventFunction& function, const State& y) {
  if (function.kind == EventKind::contact_unloads) {
    acceleration({y.data(), n_ + 1}, trial_);
    const double second = trial_[n_] - mesh_->struck_point()({trial_.data(), n_});
    return {-function.sense * indentation_rate(y), -function.sense * second};
  }
  return contact_.event_function(function.kind, indentation(y), indentation_rate(y));
}

bool StruckBeam::commit(const State& y) {
  if (contact_.loads()) contact_.commit(indentation(y));
  if (!sections_.can_yield()) return false;
  if (section_evaluation_ == Evaluation::smooth) {
    read_motion(y, committed_);
    return sections_.commit(committed_.curvatures, committed_.rates) > 0;
  }
  mesh_->curvatures(beam_positions(y), curvatures_);
  return sections_.commit(curvatures_) > 0;
}

bool StruckBeam::commit_evaluated(const State& y) {
  if (section_evaluation_ == Evaluation::smooth) return commit(y);
  if (contact_.loads()) contact_.commit(indentation(y));
  return sections_.commit(outside_) > 0;
}

BeamJacobian& StruckBeam::jacobian() const {
  if (!jacobian_) jacobian_ = std::make_unique<BeamJacobian>(*mesh_, striker_mass_);
  return *jacobian_;
}

}  // namespace subimpact
