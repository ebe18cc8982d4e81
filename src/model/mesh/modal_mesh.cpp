#include "model/mesh/modal_mesh.h"

#include <algorithm>
#include <cmath>

#include "numerics/dense.h"
#include "numerics/lanes.h"

namespace subimpact {
namespace {

using Vector = Eigen::Map<Eigen::VectorXd>;
using ConstVector = Eigen::Map<const Eigen::VectorXd>;
using ConstMatrix = Eigen::Map<const Eigen::MatrixXd>;

ConstMatrix matrix(const NaturalModes& modes) {
  return {modes.shapes.data(), index(modes.size()), index(modes.size())};
}

}  // namespace

ModalMesh::ModalMesh(std::shared_ptr<const BeamMesh> physical, double bending_stiffness)
    : BeamMesh(physical->n_unknowns(), 0, physical->symmetric()),
      physical_(std::move(physical)),
      bending_stiffness_(bending_stiffness),
      modes_(physical_->natural_modes(bending_stiffness)),
      modal_mass_(physical_->beam_mass() / static_cast<double>(n_unknowns())),
      work_(n_unknowns()),
      shear_work_(physical_->shears() ? n_unknowns() : 0) {
  const std::size_t n = n_unknowns();
  const double scale = std::sqrt(modal_mass_);
  for (double& entry : modes_.shapes) entry *= scale;
  for (std::size_t k = 0; k < n; ++k) {
    mass_.at(k, k) = modal_mass_;
    stiffness_.push_back(modal_mass_ * modes_.frequencies[k] * modes_.frequencies[k]);
  }
  struck_point_ = in_modes(physical_->struck_point());
  first_end_ = in_modes(physical_->first_end());
  const auto weights = physical_->section_weights();
  const auto positions = physical_->section_positions();
  weights_.assign(weights.begin(), weights.end());
  positions_.assign(positions.begin(), positions.end());
  struck_section_ = physical_->struck_section();
  if (!physical_->translation().empty()) {
    translation_.resize(n);
    to_modal(physical_->translation(), translation_);
  }
  const auto to_modes = [&](std::span<const double> functional, std::vector<double>& modal) {
    for (std::size_t k = 0; k < n && !functional.empty(); ++k) {
      modal.push_back(dot(functional.data(), modes_.shape(k).data(), n));
    }
  };
  to_modes(physical_->momentum_functional(), momentum_functional_);
  to_modes(physical_->moment_functional(), moment_functional_);
  to_modes(physical_->ground_force(), ground_force_);
  to_modes(physical_->ground_moment(), ground_moment_);
  for (std::size_t k = 0; k < n; ++k) {
    struck_curvature_.push_back(physical_->curvature(struck_section_, modes_.shape(k)));
  }
  beam_mass_ = physical_->beam_mass();
}

SparseFunctional ModalMesh::in_modes(const SparseFunctional& physical) const {
  SparseFunctional modal;
  if (physical.is_zero()) return modal;
  for (std::size_t k = 0; k < n_unknowns(); ++k) {
    modal.dense.push_back(physical(modes_.shape(k)));
    modal.terms.push_back({k, modal.dense.back()});
  }
  return modal;
}

std::optional<SparseFunctional> ModalMesh::displacement_at(double x) const {
  const auto physical = physical_->displacement_at(x);
  return physical ? std::optional(in_modes(*physical)) : std::nullopt;
}

std::optional<SparseFunctional> ModalMesh::rotation_at(double x) const {
  const auto physical = physical_->rotation_at(x);
  return physical ? std::optional(in_modes(*physical)) : std::nullopt;
}

double ModalMesh::scale_of_frequencies(double bending_stiffness) const {
  if (bending_stiffness == bending_stiffness_) return 1.0;
  if (shears()) throw std::logic_error("modal mesh: the modes of another stiffness are others");
  return std::sqrt(bending_stiffness / bending_stiffness_);
}

double ModalMesh::highest_frequency(double bending_stiffness) const {
  return modes_.frequencies.back() * scale_of_frequencies(bending_stiffness);
}

void ModalMesh::to_physical(std::span<const double> modal, std::span<double> physical) const {
  Vector(physical.data(), index(physical.size())).noalias() =
      matrix(modes_) * ConstVector(modal.data(), index(modal.size()));
}

void ModalMesh::to_modal(std::span<const double> physical, std::span<double> modal) const {
  physical_->mass().multiply(physical, work_);
  Vector(modal.data(), index(modal.size())).noalias() =
      matrix(modes_).transpose() * ConstVector(work_.data(), index(work_.size())) / modal_mass_;
}

double ModalMesh::curvature(std::size_t section, std::span<const double> unknowns) const {
  if (section == struck_section_) {
    return dot(struck_curvature_.data(), unknowns.data(), unknowns.size());
  }
  to_physical(unknowns, work_);
  return physical_->curvature(section, work_);
}

NaturalModes ModalMesh::natural_modes(double bending_stiffness) const {
  const std::size_t n = n_unknowns();
  NaturalModes modes;
  modes.frequencies = modes_.frequencies;
  const double ratio = scale_of_frequencies(bending_stiffness);
  for (double& frequency : modes.frequencies) frequency *= ratio;
  modes.shapes.assign(n * n, 0.0);
  for (std::size_t k = 0; k < n; ++k) modes.shapes[k * n + k] = 1.0 / std::sqrt(modal_mass_);
  return modes;
}

void ModalMesh::curvatures(std::span<const double> unknowns, std::span<double> kappa) const {
  to_physical(unknowns, work_);
  physical_->curvatures(work_, kappa);
}

void ModalMesh::bending_forces(std::span<const double> moments, std::span<double> forces) const {
  physical_->bending_forces(moments, work_);
  Vector(forces.data(), index(forces.size())).noalias() =
      matrix(modes_).transpose() * ConstVector(work_.data(), index(work_.size()));
}

void ModalMesh::add_shear_forces(std::span<const double> unknowns, std::span<double> forces) const {
  if (!shears()) return;
  to_physical(unknowns, work_);
  std::fill(shear_work_.begin(), shear_work_.end(), 0.0);
  physical_->add_shear_forces(work_, shear_work_);
  Vector(forces.data(), index(forces.size())).noalias() +=
      matrix(modes_).transpose() * ConstVector(shear_work_.data(), index(shear_work_.size()));
}

double ModalMesh::shear_energy(std::span<const double> unknowns) const {
  if (!shears()) return 0.0;
  to_physical(unknowns, work_);
  return physical_->shear_energy(work_);
}

}  // namespace subimpact
