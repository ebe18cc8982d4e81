// A user-defined section: a sandwich of two strong faces and a compliant core that yields at a
// larger strain, compared with a solid beam of the same size. The elastic stiffness of the sandwich
// is checked against the sum over the strips.

#include <cmath>
#include <cstdio>

#include "subimpact/case/simulate.h"

using subimpact::Fibres;

int main() {
  constexpr double face = 0.2;           // fraction of the half thickness
  constexpr double core_modulus = 0.05;  // as a fraction of that of the faces
  constexpr double core_yield = 0.2;     // likewise
  constexpr double core_density = 0.1;   // likewise

  subimpact::Case strike;
  strike.title = "Sandwich beam struck at the middle";
  strike.scene.beam = {.length = 0.7,
                       .width = 0.02,
                       .thickness = 0.008,
                       .density = 2600.0,
                       .youngs_modulus = 72e9,
                       .yield_stress = 150e6};
  strike.scene.striker = {.mass = 0.2, .nose_radius = 0.01, .velocity = 8.0, .position = 0.5};
  strike.model.mesh = subimpact::MeshKind::hermite;
  strike.model.elements = 60;
  strike.end_time = 2e-3;

  const subimpact::Result solid = simulate(strike);
  strike.scene.beam.density *= face + (1.0 - face) * core_density;
  strike.parts.section =
      Fibres::strips({{.from = 0.0, .to = 1.0 - face, .modulus = core_modulus, .yield = core_yield},
                      {.from = 1.0 - face, .to = 1.0}},
                     "sandwich");
  const subimpact::Result sandwich = simulate(strike);

  for (const subimpact::Result* result : {&solid, &sandwich}) {
    std::printf("%-9s %s: %zu sub-impacts, %zu of %zu sections yielded, striker ends at %.4f m/s\n",
                result->used.section.c_str(), result->outcome.message.c_str(),
                result->sub_impacts.size(), result->n_yielded_sections, result->used.n_sections,
                result->striker_velocity);
    if (!result->outcome.completed()) return 1;
  }
  const double core = std::pow(1.0 - face, 3);
  const double expected = core_modulus * core + (1.0 - core);  // E I over that of the solid
  const double found = strike.parts.section->slope();
  std::printf("E I over that of the solid section: %.12f, from the strips %.12f\n", found,
              expected);
  return std::abs(found - expected) < 1e-12 ? 0 : 1;
}
