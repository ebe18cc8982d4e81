#include "model/contact/line_contact.h"

#include <cmath>

namespace subimpact {

NoseOnBeam cylinder_across(const BodiesOfLine& of) {
  constexpr double least = 0.5;  // c pi E* b, where the law ends
  const double modulus = 1.0 / (1.0 / of.beam_modulus + 1.0 / of.nose_modulus);
  const double share = modulus / of.beam_modulus, k = of.beam_poisson / (1.0 - of.beam_poisson);
  const double widest =
      std::exp(0.5 * (share * (2.0 * std::log(2.0 * of.depth) - k) +
                      (1.0 - share) * (2.0 * std::log(4.0 * of.radius) - 1.0) - 2.0 - least));
  const double scale = 2.0 / (M_PI * of.width * modulus);
  const auto compliance = [=](double a) -> ValueAndSlope {
    if (a >= widest) return {0.5 * least * scale, 0.0};  // of trial steps
    return {scale * (std::log(widest / a) + 0.5 * least), -scale / a};
  };
  return {2, of.radius, 0.5 / (scale * of.radius), 2.0 * of.width, widest, compliance};
}

}  // namespace subimpact
