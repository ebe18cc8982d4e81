#pragma once

#include <memory>

#include "model/beam_mesh.h"
#include "model/natural_modes.h"

namespace subimpact {

/// Another mesh in the coordinates of its elastic natural modes: unknowns z with q = sum z_k phi_k
/// and the identity as mass matrix. The same beam, only its unknowns are other ones; what is banded
/// on the other mesh is dense here, so a state's curvatures cost n^2 operations.
class ModalMesh final : public BeamMesh {
 public:
  ModalMesh(std::unique_ptr<BeamMesh> physical, double bending_stiffness);

  const BeamMesh& physical() const { return *physical_; }
  std::span<const double> frequencies() const { return modes_.frequencies; }  ///< rad/s

  void curvatures(std::span<const double> unknowns, std::span<double> kappa) const override;
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override;
  SectionStencil section_stencil(std::size_t section) const override;
  /// That of the last mode.
  double highest_frequency(double bending_stiffness) const override;
  std::span<const double> modal_stiffness() const override { return stiffness_; }
  std::string description() const override;

  /// q = sum z_k phi_k.
  void to_physical(std::span<const double> modal, std::span<double> physical) const;
  /// z_k = phi_k^T Mass q.
  void to_modal(std::span<const double> physical, std::span<double> modal) const;

 private:
  std::unique_ptr<BeamMesh> physical_;
  double bending_stiffness_;
  NaturalModes modes_;
  std::vector<double> stiffness_;
  mutable std::vector<double> work_;
};

}  // namespace subimpact
