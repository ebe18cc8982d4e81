#pragma once

#include <algorithm>
#include <array>

#include "subimpact/model/mesh/beam_mesh.h"

namespace subimpact {

/// The beam as a rigid body, free at both ends: the limit of a beam whose bending stiffness grows
/// without bound. For impacts of two bodies, which have answers in closed form.
///
///     w(x) = q_0 + q_1 (x - l/2),   Mass = diag(rho A l, rho A l^3/12 + J l)
///
/// q_0 in m; q_1, a slope, only where the strike is off mid-span. One section stands for all; its
/// curvature is zero. A fixed beam is struck without moving: S = 0.
class RigidMesh final : public BeamMesh {
 public:
  /// `position` is the struck point as a fraction of the length.
  RigidMesh(const Beam& beam, double position)
      : BeamMesh(position == 0.5 && !turns(beam) ? 1 : 2, 0, false),
        length_(beam.length),
        fixed_(beam.fixed) {
    mass_.at(0, 0) = beam_mass_ = beam.mass();
    struck_point_.terms = {{0, 1.0}};
    if (n_unknowns() == 2) {
      struck_point_.terms.push_back({1, (position - 0.5) * length_});
      mass_.at(1, 1) = beam.mass() * length_ * length_ / 12.0 + beam.rotary_inertia() * length_;
    }
    first_end_ = *displacement_at(0.0);
    translation_.assign(n_unknowns(), 0.0);
    translation_[0] = 1.0;
    momentum_functional_.assign(n_unknowns(), 0.0);
    momentum_functional_[0] = beam.mass();
    if (n_unknowns() == 2) {
      moment_functional_ = {0.5 * length_ * beam.mass(), mass_.at(1, 1)};
    }
    if (beam.fixed) {
      struck_point_.terms = {{0, 0.0}};
      translation_.clear();
      momentum_functional_.assign(n_unknowns(), 0.0);
    }
    weights_ = {length_};
    positions_ = {position * length_};
    add_stencil(0, std::array{0.0});
  }

  void curvatures(std::span<const double>, std::span<double> kappa) const override {
    std::ranges::fill(kappa, 0.0);
  }
  void bending_forces(std::span<const double>, std::span<double> forces) const override {
    std::ranges::fill(forces, 0.0);
  }
  std::optional<SparseFunctional> displacement_at(double x) const override {
    if (fixed_) return SparseFunctional{};
    SparseFunctional displacement{{{0, 1.0}}, {}};
    if (n_unknowns() == 2) displacement.terms.push_back({1, x - 0.5 * length_});
    return displacement;
  }
  std::optional<SparseFunctional> rotation_at(double) const override {
    return n_unknowns() == 1 ? SparseFunctional{} : SparseFunctional{{{1, 1.0}}, {}};
  }
  double highest_frequency(double) const override { return 0.0; }
  std::string description() const override { return "a rigid body"; }

 private:
  // Whether it turns although it is struck at mid-span.
  static bool turns(const Beam& beam) {
    const auto off_middle = [](const auto& at) { return at.position != 0.5; };
    return beam.angular_velocity != 0.0 || std::ranges::any_of(beam.forces, off_middle) ||
           std::ranges::any_of(beam.springs, off_middle);
  }

  double length_;
  bool fixed_;
};

}  // namespace subimpact
