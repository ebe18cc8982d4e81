#pragma once

#include "subimpact/model/beam_mesh.h"

namespace subimpact {

/// The beam as a rigid body, free at both ends: the limit of a beam whose bending stiffness grows
/// without bound. For impacts of two bodies, which have answers in closed form.
///
///     w(x) = q_0 + q_1 (x - l/2),   Mass = diag(rho A l, rho A l^3/12 + J l)
///
/// q_0 in m; q_1, a slope, only where the strike is off mid-span. One section stands for all; its
/// curvature is zero.
class RigidMesh final : public BeamMesh {
 public:
  /// `position` is the struck point as a fraction of the length.
  RigidMesh(const Beam& beam, double position);

  void curvatures(std::span<const double> unknowns, std::span<double> kappa) const override;
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override;
  std::optional<SparseFunctional> displacement_at(double x) const override;
  std::optional<SparseFunctional> rotation_at(double x) const override;
  double highest_frequency(double bending_stiffness) const override;  ///< 0
  std::string description() const override { return "a rigid body"; }

 private:
  double length_;
};

}  // namespace subimpact
