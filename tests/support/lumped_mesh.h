#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "subimpact/model/mesh/beam_mesh.h"

namespace subimpact {

/// A "beam" of one unknown: a mass, tied to the ground by a spring (stiffness 0: free).
class LumpedMesh final : public BeamMesh {
 public:
  explicit LumpedMesh(double mass) : BeamMesh(1, 0, false) {
    mass_.at(0, 0) = mass;
    weights_ = {1.0};
    positions_ = {0.0};
    struck_point_.terms = {{0, 1.0}};
    first_end_.terms = {{0, 1.0}};
    translation_ = {1.0};
    momentum_functional_ = {mass};
    beam_mass_ = mass;
  }
  void curvatures(std::span<const double> w, std::span<double> kappa) const override {
    kappa[0] = w[0];
  }
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override {
    forces[0] = -moments[0];
  }
  SectionStencil section_stencil(std::size_t) const override { return {0, one_}; }
  double highest_frequency(double stiffness) const override {
    return std::sqrt(stiffness / mass_.at(0, 0));
  }
  std::string description() const override { return "one mass"; }

 private:
  std::vector<double> one_{1.0};
};

}  // namespace subimpact
