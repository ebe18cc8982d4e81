// A user-defined contact law: loading along k1, unloading and reloading along the steeper k2
// (Walton and Braun 1986). The restitution is sqrt(k1/k2) at any velocity.

#include <cmath>
#include <cstdio>
#include <memory>

#include "subimpact/case/simulate.h"

using subimpact::ContactHistory;

class WaltonBraun final : public subimpact::ContactLaw {
 public:
  WaltonBraun(double k1, double k2) : k1_(k1), k2_(k2) {}

  std::string name() const override { return "Walton and Braun"; }
  double residual_indentation(ContactHistory history) const override {
    return (1.0 - k1_ / k2_) * history.max_indentation;
  }
  double yield_threshold(ContactHistory history) const override { return history.max_indentation; }
  double force(ContactHistory history, double indentation) const override {
    return k2_ * (indentation - residual_indentation(history));
  }

 private:
  double k1_, k2_;  // N/m
};

int main() {
  subimpact::Case strike;
  strike.scene.beam = {
      .length = 1.0, .width = 0.1, .thickness = 0.1, .density = 7800.0, .youngs_modulus = 210e9};
  strike.scene.striker = {.mass = 0.2, .nose_radius = {}, .velocity = 1.0, .position = 0.5};
  strike.model.mesh = subimpact::MeshKind::rigid;
  strike.end_time = 2e-3;
  double worst = 0.0;
  for (const double ratio : {0.25, 0.5, 0.9}) {
    strike.parts.contact_law = std::make_shared<WaltonBraun>(1e7, 1e7 / ratio);
    const subimpact::Result result = simulate(strike);
    if (!result.outcome.completed()) return std::puts(result.outcome.message.c_str()), 1;
    const double restitution = result.beam_mean_velocity - result.striker_velocity;  // of 1 m/s
    std::printf("%s, k1/k2 = %.2f: restitution %.9f, sqrt(k1/k2) = %.9f, peak %.1f N\n",
                result.used.contact_law.c_str(), ratio, restitution, std::sqrt(ratio),
                result.max_force);
    worst = std::fmax(worst, std::abs(restitution - std::sqrt(ratio)));
  }
  return worst < 1e-7 ? 0 : 1;
}
