// Two observers of one run: one sees the strain along the beam, the other ends the run after the
// third sub-impact.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "subimpact/case/simulate.h"

using subimpact::RunView;

struct LargestStrain final : subimpact::Observer {
  explicit LargestStrain(const subimpact::Beam& of) : beam(of) {}
  void on_step(const RunView& now) override {
    for (const double share : {0.1, 0.2, 0.3, 0.4, 0.5}) {
      const double strain = 0.5 * beam.thickness * std::abs(now.curvature(share * beam.length));
      if (strain > largest) largest = strain, where = share * beam.length;
    }
  }
  const subimpact::Beam& beam;
  double largest = 0.0, where = 0.0;
};

struct EndAfterThird final : subimpact::Observer {
  void after_event(const subimpact::Transition& event, const RunView&) override {
    if (event.kind == subimpact::EventKind::contact_ends) ++ended;
  }
  bool goes_on() const override { return ended < 3; }
  int ended = 0;
};

int main() {
  subimpact::Case strike;
  strike.scene.beam = {.length = 0.7112,
                       .width = 0.0163,
                       .thickness = 0.0075,
                       .density = 2600.0,
                       .youngs_modulus = 71.96e9,
                       .yield_stress = 150e6};
  strike.scene.striker = {.mass = 0.201, .nose_radius = 0.01, .velocity = 15.9};
  strike.model.segments = 151;
  strike.end_time = 8e-3;

  LargestStrain strain(strike.scene.beam);
  EndAfterThird end;
  subimpact::Observers both{&strain, &end};
  const subimpact::Result result = simulate(strike, both);
  std::printf("%s; largest strain %.4f at %.3f m\n", result.brief_report().c_str(), strain.largest,
              strain.where);
  const bool is_right = result.outcome.kind == subimpact::OutcomeKind::stopped &&
                        result.sub_impacts.size() == 3 && result.outcome.time < 1e-3 &&
                        strain.largest > 150e6 / 71.96e9;  // the beam yields
  return is_right ? 0 : 1;
}
