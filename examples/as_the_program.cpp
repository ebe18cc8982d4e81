// What `subimpact run` computes, number for number: mesh and method chosen, errors from coarser
// meshes. simulate(strike) would be one run on the mesh that the case has.

#include <cstdio>

#include "subimpact/study/run_as_asked.h"

int main() {
  subimpact::Case strike;
  strike.scene.beam = {.length = 0.7112,
                       .width = 0.0163,
                       .thickness = 0.0075,
                       .density = 2600.0,
                       .youngs_modulus = 71.96e9,
                       .yield_stress = 150e6};
  strike.scene.striker = {.mass = 0.201, .nose_radius = 0.01, .velocity = 15.9};
  strike.end_time = 3e-4;
  const auto [chosen, result, beside] = subimpact::run_as_asked(strike);
  for (const auto& hit : result.sub_impacts) {
    if (!hit.end || !hit.end_error) continue;
    std::printf("%.3f to %.3f us, +- %.3f: %s\n", 1e6 * hit.start, 1e6 * *hit.end,
                1e6 * *hit.end_error, hit.certain.value_or(false) ? "certain" : "uncertain");
  }
  return result.error_estimate && chosen.model.segments != strike.model.segments ? 0 : 1;
}
