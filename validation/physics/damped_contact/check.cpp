// Two rigid bodies with Hunt and Crossley's contact: restitution in closed form.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outcome.h"
#include "subimpact/case/simulate.h"

namespace subimpact::validation {
namespace {

// e of x - ln(1 + x) = -x e - ln(1 - x e), x = chi v_0, by bisection.
double restitution(double x) {
  const double lost = x - std::log1p(x);
  double low = 0.0;
  double high = std::min(1.0, 1.0 / x);
  for (int i = 0; i < 200; ++i) {
    const double e = 0.5 * (low + high);
    (-x * e - std::log1p(-x * e) < lost ? low : high) = e;
  }
  return 0.5 * (low + high);
}

}  // namespace

Outcome check_damped_contact() {
  Outcome outcome{"closed form", {}, {}};
  for (const auto& [law, stiffness] : {std::pair("hertz", 3e10), std::pair("linear", 2e7)}) {
    for (const double x : {0.02, 0.1, 0.4, 1.0, 6.0}) {
      Case input = case_of("damped_contact", {fmt::format("contact.law={}", law),
                                              fmt::format("contact.stiffness={}", stiffness)});
      input.scene.contact.damping = x / input.scene.striker.velocity;
      const Result result = simulate(input);
      const double e =
          (result.beam_mean_velocity - result.striker_velocity) / input.scene.striker.velocity;
      outcome.rows.push_back({fmt::format("{}: restitution at χv = {}", law, x), restitution(x), e,
                              Bound::relative, 1e-8});
    }
  }
  return outcome;
}

}  // namespace subimpact::validation
