// A user-defined mesh from its matrices: a chain of rigid bars between point masses, with a hinge
// and a rotational spring at every mass (Hencky 1920). The end of the first sub-impact on this mesh
// is compared with that on the built-in cells.

#include <cmath>
#include <cstdio>

#include "subimpact/case/simulate.h"
#include "subimpact/model/mesh/matrix_mesh.h"

// `bars`: even, so that a mass is struck.
std::shared_ptr<const subimpact::BeamMesh> bar_chain(const subimpact::Beam& beam,
                                                     std::size_t bars) {
  const double h = beam.length / static_cast<double>(bars);
  subimpact::MeshMatrices chain{.mass = {bars + 1, 0}};
  for (std::size_t i = 0; i <= bars; ++i) {
    const bool is_end = i == 0 || i == bars;
    chain.mass.at(i, i) = beam.mass() / static_cast<double>(bars) * (is_end ? 0.5 : 1.0);
    if (is_end) continue;  // free: no spring
    chain.curvature.push_back({i - 1, {1.0 / (h * h), -2.0 / (h * h), 1.0 / (h * h)}});
    chain.weights.push_back(h);
    chain.positions.push_back(h * static_cast<double>(i));
  }
  chain.struck_point.terms = {{bars / 2, 1.0}};
  chain.translation.assign(bars + 1, 1.0);
  chain.description = "a chain of rigid bars";
  return mesh_of(std::move(chain));
}

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
  strike.parts.mesh = bar_chain(strike.scene.beam, 500);
  const subimpact::Result bars = simulate(strike);
  for (const auto* result : {&cells, &bars}) {
    std::printf("%s: %s\n", result->used.mesh.c_str(), result->brief_report().c_str());
    if (!result->is_usable() || result->sub_impacts.empty()) return 1;
  }
  const double ratio = *bars.sub_impacts[0].end / *cells.sub_impacts[0].end;
  std::printf("first end, over that on cells: %.5f\n", ratio);
  return std::abs(ratio - 1.0) < 0.01 ? 0 : 1;
}
