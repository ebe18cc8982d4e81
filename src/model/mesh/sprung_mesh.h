#pragma once

#include <memory>

#include "subimpact/model/mesh/beam_mesh.h"
#include "subimpact/model/scene.h"

namespace subimpact {

/// Another mesh on springs to the ground and a uniform elastic bedding, which join its stiffness
/// K_s (docs/theory/beam.md, "Scenes"). A free beam on springs conserves no momentum: translation()
/// is empty.
class SprungMesh final : public BeamMesh {
 public:
  /// `n_parts`: intervals of the quadrature over the whole beam; `one_point`: at their middle, of
  /// meshes that have one unknown there, otherwise Gauss points. Throws std::invalid_argument for a
  /// mesh without displacement_at() or in natural modes.
  SprungMesh(std::shared_ptr<const BeamMesh> other, const Beam& beam, std::size_t n_parts,
             bool one_point);

  bool is_sprung() const override { return true; }
  void curvatures(std::span<const double> unknowns, std::span<double> kappa) const override {
    other_->curvatures(unknowns, kappa);
  }
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override {
    other_->bending_forces(moments, forces);
  }
  SectionStencil section_stencil(std::size_t section) const override {
    return other_->section_stencil(section);
  }
  void add_shear_forces(std::span<const double> unknowns, std::span<double> forces) const override;
  double shear_energy(std::span<const double> unknowns) const override;
  std::optional<SparseFunctional> displacement_at(double x) const override {
    return other_->displacement_at(x);
  }
  std::optional<SparseFunctional> rotation_at(double x) const override {
    return other_->rotation_at(x);
  }
  std::vector<Slope> slopes() const override { return other_->slopes(); }
  /// An upper bound: the sum of the squares of both.
  double highest_frequency(double bending_stiffness) const override;
  bool prefers_modes() const override { return other_->prefers_modes(); }
  std::string description() const override { return other_->description() + ", on springs"; }

 private:
  void add_spring(double x, double stiffness, double length);

  std::shared_ptr<const BeamMesh> other_;
  BandedMatrix springs_;
  double frequency_squared_ = 0.0;  // of the springs alone, bound
};

}  // namespace subimpact
