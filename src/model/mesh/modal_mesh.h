#pragma once

#include <memory>
#include <stdexcept>

#include "subimpact/model/mesh/beam_mesh.h"

namespace subimpact {

/// The end of the description of a mesh in modes.
inline constexpr const char* modal_description = ", in natural modes";

/// Another mesh in the coordinates of its elastic natural modes: unknowns z with q = sum z_k phi_k.
/// The same beam, only its unknowns are other ones. While it is elastic mass and stiffness are
/// diagonal; what is banded on the other mesh is dense here, so all curvatures of a state cost n^2
/// operations, one of them n.
///
/// Each mode is scaled to an n-th part of the beam's mass, phi_k^T Mass phi_k = m_beam/n. So the
/// unknowns are lengths, and their root mean square is that of the beam's displacement: tolerances
/// mean here what they mean on other meshes.
class ModalMesh final : public BeamMesh {
 public:
  ModalMesh(std::shared_ptr<const BeamMesh> physical, double bending_stiffness);

  const BeamMesh& physical() const { return *physical_; }
  std::span<const double> frequencies() const { return modes_.frequencies; }  ///< rad/s

  void curvatures(std::span<const double> unknowns, std::span<double> kappa) const override;
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override;
  SectionStencil section_stencil(std::size_t /*section*/) const override {
    throw std::logic_error("modal mesh: a section's curvature depends on all unknowns");
  }
  bool shears() const override { return physical_->shears(); }
  bool is_sprung() const override { return physical_->is_sprung(); }
  void add_shear_forces(std::span<const double> unknowns, std::span<double> forces) const override;
  double shear_energy(std::span<const double> unknowns) const override;
  double curvature(std::size_t section, std::span<const double> unknowns) const override;
  SparseFunctional curvature_functional(std::size_t section) const override {
    return in_modes(physical_->curvature_functional(section));
  }
  std::optional<SparseFunctional> displacement_at(double x) const override;
  std::optional<SparseFunctional> rotation_at(double x) const override;
  double highest_frequency(double bending_stiffness) const override;
  NaturalModes natural_modes(double bending_stiffness) const override;
  bool has_closed_modes() const override { return physical_->has_closed_modes(); }
  double closed_modes_work() const override { return physical_->closed_modes_work(); }
  std::span<const double> modal_stiffness() const override { return stiffness_; }
  std::string description() const override { return physical_->description() + modal_description; }

  void to_physical(std::span<const double> modal, std::span<double> physical) const;
  /// z_k = phi_k^T Mass q/(m_beam/n).
  void to_modal(std::span<const double> physical, std::span<double> modal) const;

 private:
  SparseFunctional in_modes(const SparseFunctional& physical) const;
  // Frequencies with this bending stiffness over those with that of the modes. Throws
  // std::logic_error if it is another one and sections shear.
  double scale_of_frequencies(double bending_stiffness) const;

  std::shared_ptr<const BeamMesh> physical_;
  double bending_stiffness_;
  NaturalModes modes_;
  double modal_mass_;  // kg, of every mode
  std::vector<double> stiffness_;
  std::vector<double> struck_curvature_;  // of the struck section, by unknowns
  mutable std::vector<double> work_, shear_work_;
};

}  // namespace subimpact
