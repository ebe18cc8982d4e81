// A user-defined mesh: a chain of rigid bars between point masses, with a hinge and a rotational
// spring at every mass (Hencky 1920). The end of the first sub-impact on this mesh is compared with
// that on the built-in cells.

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

#include "subimpact/case/simulate.h"

class BarChain final : public subimpact::BeamMesh {
 public:
  BarChain(const subimpact::Beam& beam, std::size_t bars)  // even, so that a mass is struck
      : BeamMesh(bars + 1, 0, false),
        h_(beam.length / bars),
        mass_per_length_(beam.mass() / beam.length) {
    for (std::size_t i = 0; i <= bars; ++i) {
      const double mass = mass_per_length_ * h_ * (i == 0 || i == bars ? 0.5 : 1.0);
      mass_.at(i, i) = mass;
      momentum_functional_.push_back(mass);
      if (i == 0 || i == bars) continue;  // the ends are free: no spring
      positions_.push_back(h_ * static_cast<double>(i));
      weights_.push_back(h_);
    }
    translation_.assign(bars + 1, 1.0);
    beam_mass_ = beam.mass();
    struck_point_.terms = {{bars / 2, 1.0}};
    first_end_.terms = {{0, 1.0}};
    struck_section_ = bars / 2 - 1;
    row_ = {1.0 / (h_ * h_), -2.0 / (h_ * h_), 1.0 / (h_ * h_)};
  }

  void curvatures(std::span<const double> w, std::span<double> kappa) const override {
    for (std::size_t i = 0; i < kappa.size(); ++i) {
      kappa[i] = row_[0] * w[i] + row_[1] * w[i + 1] + row_[2] * w[i + 2];
    }
  }
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override {
    for (double& force : forces) force = 0.0;
    for (std::size_t i = 0; i < moments.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) forces[i + k] -= h_ * row_[k] * moments[i];
    }
  }
  SectionStencil section_stencil(std::size_t section) const override { return {section, row_}; }
  double highest_frequency(double bending_stiffness) const override {
    return 4.0 / (h_ * h_) * std::sqrt(bending_stiffness / mass_per_length_);
  }
  std::string description() const override { return "a chain of rigid bars"; }

 private:
  double h_, mass_per_length_;   // m, kg/m
  std::array<double, 3> row_{};  // of B, 1/m2
};

int main() {
  subimpact::Case strike;
  strike.scene.beam = {.length = 0.7112,
                       .width = 0.0163,
                       .thickness = 0.0075,
                       .density = 2600.0,
                       .youngs_modulus = 71.96e9,
                       .yield_stress = 150e6,
                       .theory = subimpact::BeamTheory::euler_bernoulli};
  strike.scene.striker = {.mass = 0.201, .nose_radius = 0.01, .velocity = 15.9, .position = 0.5};
  strike.end_time = 3e-4;
  const subimpact::Result cells = simulate(strike);
  strike.parts.mesh = std::make_shared<BarChain>(strike.scene.beam, 500);
  const subimpact::Result bars = simulate(strike);
  for (const auto* result : {&cells, &bars}) {
    std::printf("%s: %s\n", result->used.mesh.c_str(), result->brief_report().c_str());
    if (!result->is_usable() || result->sub_impacts.empty()) return 1;
  }
  const double ratio = *bars.sub_impacts[0].end / *cells.sub_impacts[0].end;
  std::printf("first end, over that on cells: %.5f\n", ratio);
  return std::abs(ratio - 1.0) < 0.01 ? 0 : 1;
}
