#include "system/struck_beam.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/contact_laws.h"

namespace subimpact {

StruckBeam::StruckBeam(const Scene& scene, std::shared_ptr<const BeamMesh> mesh,
                       SectionField sections, std::unique_ptr<MassSolver> mass_solver)
    : StruckBeam(StruckBeamParts{std::move(mesh), std::move(sections), make_contact_law(scene),
                                 scene.striker.mass, scene.striker.velocity,
                                 0.5 * scene.beam.youngs_modulus * scene.beam.thickness,
                                 std::move(mass_solver)}) {}

StruckBeam::StruckBeam(StruckBeamParts parts)
    : mesh_(std::move(parts.mesh)),
      sections_(std::move(parts.sections)),
      contact_law_(std::move(parts.contact_law)),
      mass_solver_(std::move(parts.mass_solver)),
      n_(mesh_->n_unknowns()),
      striker_mass_(parts.striker_mass),
      striker_velocity_(parts.striker_velocity),
      outer_stiffness_(parts.outer_stiffness),
      highest_frequency_(mesh_->highest_frequency(sections_.stiffness())),
      curvatures_(mesh_->n_sections()),
      moments_(mesh_->n_sections()),
      trial_(n_ + 1),
      start_(mesh_->n_sections()),
      end_(mesh_->n_sections()),
      influence_(std::make_unique<SectionInfluence>(*mesh_, *mass_solver_)),
      kinks_(*influence_),
      velocity_change_(n_),
      position_change_(n_) {
  const auto [stiffness, exponent] = contact_law_->scales();
  const double contact_time =
      std::pow(striker_mass_ / (stiffness * std::pow(striker_velocity_, exponent - 1.0)),
               1.0 / (exponent + 1.0));
  scales_ = {striker_velocity_ * contact_time, striker_velocity_};
  if (sections_.can_yield()) return;
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

double StruckBeam::force(double indentation) const {
  if (contact_evaluation_ == Evaluation::switching) {
    return contact_law_->force(contact_history_, indentation);
  }
  return contact_law_->branch_force(contact_branch_, contact_history_, indentation);
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
    sections_.moments(curvatures_, moments_);
  }
  mesh_->bending_forces(moments_, forces);
}

void StruckBeam::acceleration(std::span<const double> positions, std::span<double> result) {
  ++n_accelerations_;
  const auto unknowns = positions.first(n_);
  const auto forces = result.first(n_);
  const double contact = force(positions[n_] - mesh_->struck_point()(unknowns));
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
  const double contact = force(positions[n_] - mesh_->struck_point()(unknowns));
  mesh_->struck_point().add_to(forces, contact);
  result[n_] = -contact;
}

double StruckBeam::force_slope(double indentation) const {
  const ContactBranch branch = contact_evaluation_ == Evaluation::switching
                                   ? contact_law_->branch(contact_history_, indentation)
                                   : contact_branch_;
  return contact_law_->branch_slope(branch, contact_history_, indentation);
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
      part == Part::stiff ? 0.0 : force_slope(positions[n_] - mesh_->struck_point()(unknowns));
  jacobian().stiffness_entries(moments_, slope, values);
}

double StruckBeam::indentation(const State& y) const {
  return y[n_] - mesh_->struck_point()(beam_positions(y));
}

double StruckBeam::indentation_rate(const State& y) const {
  return y.back() - mesh_->struck_point()(beam_velocities(y));
}

// --- memory -------------------------------------------------------------------------------------

void StruckBeam::apply(const Guard& guard, const State& y) {
  switch (guard.kind) {
    case EventKind::contact_begins:
      contact_branch_ = contact_law_->first_branch(contact_history_);
      break;
    case EventKind::contact_yields:
      contact_branch_ = ContactBranch::plastic;
      break;
    case EventKind::contact_unloads:
      contact_history_ = contact_law_->commit(contact_history_, indentation(y));
      contact_branch_ = ContactBranch::elastic;
      break;
    case EventKind::contact_ends:
      contact_branch_ = ContactBranch::separated;
      break;
    case EventKind::section_reverses:
      break;  // see put_right
  }
}

bool StruckBeam::commit(const State& y) {
  if (contact_branch_ == ContactBranch::plastic || contact_evaluation_ == Evaluation::switching) {
    contact_history_ = contact_law_->commit(contact_history_, indentation(y));
  }
  if (!sections_.can_yield()) return false;
  read_motion(y, start_);
  return section_evaluation_ == Evaluation::smooth
             ? sections_.commit(start_.curvatures, start_.rates) > 0
             : sections_.commit(start_.curvatures) > 0;
}

void StruckBeam::follow_branch(const State& y) {
  contact_branch_ = contact_law_->branch(contact_history_, indentation(y));
}

void StruckBeam::read_motion(const State& y, SectionMotion& at) const {
  mesh_->curvatures(beam_positions(y), at.curvatures);
  mesh_->curvatures(beam_velocities(y), at.rates);
}

// --- accounts -----------------------------------------------------------------------------------

Energies StruckBeam::energies(const State& y) {
  Energies sum;
  sum.striker = 0.5 * striker_mass_ * y.back() * y.back();
  sum.beam_kinetic = 0.5 * mesh_->mass().quadratic_form(beam_velocities(y));
  if (!modal_stiffness_.empty()) {
    for (std::size_t i = 0; i < n_; ++i) sum.bending_elastic += modal_stiffness_[i] * y[i] * y[i];
    sum.bending_elastic *= 0.5;
  } else {
    mesh_->curvatures(beam_positions(y), curvatures_);
    const auto bending = sections_.energies(curvatures_, mesh_->section_weights());
    sum.bending_elastic = bending.elastic;
    sum.bending_plastic = bending.plastic;
  }
  const double lambda = indentation(y);
  const bool advances =
      contact_branch_ == ContactBranch::plastic || contact_evaluation_ == Evaluation::switching;
  const ContactHistory reached =
      advances ? contact_law_->commit(contact_history_, lambda) : contact_history_;
  sum.contact_plastic = contact_law_->dissipated_energy(reached);
  if (in_contact()) sum.contact_elastic = contact_law_->recoverable_energy(reached, lambda);
  return sum;
}

double StruckBeam::momentum(const State& y) const {
  return striker_mass_ * y.back() + beam_momentum(y);
}

double StruckBeam::beam_momentum(const State& y) const {
  return dot(mesh_->momentum_functional().data(), beam_velocities(y).data(), n_);
}

BeamJacobian& StruckBeam::jacobian() const {
  if (!jacobian_) jacobian_ = std::make_unique<BeamJacobian>(*mesh_, striker_mass_);
  return *jacobian_;
}

StruckBeam::Displacements StruckBeam::displacements(const State& y) const {
  const auto unknowns = beam_positions(y);
  return {mesh_->struck_point()(unknowns), y[n_], mesh_->first_end()(unknowns)};
}

StruckBeam::Bending StruckBeam::bending(const State& y) {
  mesh_->curvatures(beam_positions(y), curvatures_);
  sections_.moments(curvatures_, moments_);
  return {curvatures_, moments_};
}

double StruckBeam::back_stress(const State& y) {
  const std::size_t section = mesh_->struck_section();
  return sections_.outer_stress(section, mesh_->curvature(section, beam_positions(y)),
                                outer_stiffness_);
}

}  // namespace subimpact
