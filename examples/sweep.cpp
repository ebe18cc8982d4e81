// A sweep: the largest force over the velocity of the strike and two noses, runs beside one
// another.

#include <cstdio>

#include "subimpact/study/population.h"

int main() {
  subimpact::Case strike;
  strike.scene.beam = {.length = 0.7112,
                       .width = 0.0163,
                       .thickness = 0.0075,
                       .density = 2600.0,
                       .youngs_modulus = 71.96e9,
                       .yield_stress = 150e6};
  strike.scene.striker = {.mass = 0.201, .nose_radius = 0.01, .velocity = 1.0};
  strike.model.segments = 101;
  strike.end_time = 4e-4;

  subimpact::Population population;
  population.axes = {{{"striker.nose_radius"}, {{0.01}, {0.02}}},
                     {{"striker.velocity"}, {{2.0}, {4.0}, {8.0}, {16.0}}}};
  const std::vector<subimpact::Result> results = sweep(strike, population, 2);
  for (std::size_t i = 0; i < results.size(); ++i) {
    for (const auto& [key, value] : population.settings(strike, i)) {
      std::printf("%s = %-6g ", key.c_str(), std::get<double>(value));
    }
    std::printf("%8.1f N, %zu sub-impacts\n", results[i].max_force, results[i].sub_impacts.size());
    const bool is_slowest = i % 4 == 0;
    if (!is_slowest && results[i].max_force <= results[i - 1].max_force) return 1;
  }
  return results.size() == 8 ? 0 : 1;
}
