// A user-defined integrator (velocity_verlet.h) beside the built-in methods, at one step: the
// program locates its events, states their errors and compares them with a reference.

#include <cmath>
#include <cstdio>

#include "subimpact/report/text.h"
#include "subimpact/study/studies.h"
#include "velocity_verlet.h"

int main() {
  subimpact::Case strike;
  strike.scene.beam = {.length = 0.7112,
                       .width = 0.0163,
                       .thickness = 0.0075,
                       .density = 2600.0,
                       .youngs_modulus = 71.96e9,
                       .theory = subimpact::BeamTheory::rayleigh};
  strike.scene.striker = {.mass = 0.201, .nose_radius = {}, .velocity = 15.9, .position = 0.5};
  strike.scene.contact.kind = subimpact::ContactKind::linear;
  strike.scene.contact.stiffness = 2e7;
  strike.model.segments = 51;
  strike.model.section = subimpact::SectionKind::elastic;
  strike.end_time = 1e-3;
  strike.solver.method = subimpact::Method::own;
  strike.parts.integrator = velocity_verlet();

  double before = 0.0, order = 0.0;
  for (const double step : {0.2e-6, 0.1e-6, 0.05e-6}) {
    strike.solver.step = step;
    const auto compared =
        subimpact::compare(strike, {"own", "central-difference", "erk:zonneveld"});
    std::printf("%s\n", subimpact::comparison_table(compared).c_str());
    const auto& own = compared.runs.front();
    if (!own.has_errors() || own.errors.unmatched) return 1;
    if (before > 0.0) order = std::log2(before / own.errors.maximum);
    before = own.errors.maximum;
  }
  std::printf("order of the events by velocity Verlet: %.2f\n", order);
  return std::abs(order - 2.0) < 0.05 ? 0 : 1;
}
