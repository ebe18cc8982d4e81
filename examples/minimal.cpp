// A mass strikes a free beam: prints its first sub-impacts.
#include <cstdio>

#include "subimpact/case/simulate.h"

int main() {
  subimpact::Case strike;  // SI units
  strike.scene.beam = {.length = 0.7112,
                       .width = 0.0163,
                       .thickness = 0.0075,
                       .density = 2600.0,
                       .youngs_modulus = 71.96e9,
                       .yield_stress = 150e6};
  strike.scene.striker = {.mass = 0.201, .nose_radius = 0.01, .velocity = 15.9};
  strike.end_time = 2e-3;
  const subimpact::Result result = subimpact::simulate(strike);
  for (const auto& hit : result.sub_impacts) {
    std::printf("%g s, %g N\n", hit.start, hit.peak_force);
  }
  return result.sub_impacts.empty() ? 1 : 0;
}
