// A user-defined observer: follows the gap between striker and beam, and the rate at which plastic
// hinges dissipate energy, in a run that stores no history.

#include <algorithm>
#include <cstdio>

#include "subimpact/case/simulate.h"

using subimpact::EventKind;
using subimpact::RunView;

struct Watcher final : subimpact::Observer {
  void on_step(const RunView& now) override {
    ++steps;
    largest_gap = std::max(largest_gap, -now.indentation());
    const double plastic = now.energies().bending_plastic;
    if (now.time() > last_time) {
      most_power = std::max(most_power, (plastic - last_plastic) / (now.time() - last_time));
    }
    last_time = now.time();
    last_plastic = plastic;
  }

  void after_event(const subimpact::Transition& event, const RunView& at) override {
    if (event.kind == EventKind::contact_begins) {
      std::printf("%9.3f us: touch at %.3f m/s\n", 1e6 * event.time,
                  at.striker().velocity - at.struck_point().velocity);
      ++touches;
    }
  }

  long steps = 0;
  std::size_t touches = 0;
  double largest_gap = 0.0, most_power = 0.0;

 private:
  double last_time = 0.0, last_plastic = 0.0;
};

int main() {
  subimpact::Case strike;
  strike.scene.beam = {.length = 0.7112,
                       .width = 0.0163,
                       .thickness = 0.0075,
                       .density = 2600.0,
                       .youngs_modulus = 71.96e9,
                       .yield_stress = 150e6};
  strike.scene.striker = {.mass = 0.201, .nose_radius = 0.01, .velocity = 15.9, .position = 0.5};
  strike.model.segments = 151;
  strike.end_time = 1e-3;
  strike.output.interval = 0.0;

  Watcher watcher;
  const subimpact::Result result = simulate(strike, watcher);
  std::printf("%ld steps, %zu touches, largest gap %.4f mm, most plastic power %.1f kW\n",
              watcher.steps, watcher.touches, 1e3 * watcher.largest_gap, 1e-3 * watcher.most_power);
  return result.outcome.completed() && watcher.touches == result.sub_impacts.size() ? 0 : 1;
}
