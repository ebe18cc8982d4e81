#include "model/hermite_chain_waves.h"

#include <cmath>

namespace subimpact::chain {
// Written so that long waves, and those near the ends of the optical branch, keep their digits.
template <class Kind>
WavesOf<Kind> waves_at(const typename Kind::Number& p, Band band, const Element& k, bool clamped) {
  using Number = typename Kind::Number;
  const bool acoustic = band == Band::acoustic;
  const Number q = p * (2.0 - p);
  const Number u = 0.5 - k.of_c * p;
  const Number v = k.of_b_and_e - k.of_e * p;
  const Number gamma = 12.0 * p * p;
  const Number beta = 12.0 * p * v + u * (6.0 - 2.0 * p) - 12.0 * k.of_d * q;
  const Number alpha = u * v - k.of_d * k.of_d * q;
  const Number root = sqrt_of(beta * beta - 4.0 * alpha * gamma);
  const Number lambda = acoustic ? 2.0 * gamma / (beta + root) : (beta + root) / (2.0 * alpha);
  const Number c = -12.0 - lambda * k.of_c;
  const Number d = 6.0 - lambda * k.of_d;
  const Number e = 2.0 - lambda * k.of_e;
  const Number leading = c * e + d * d;
  // A + C cos(theta) and B + E cos(theta); what may be small of them comes from their product.
  const Number of_w = 12.0 * p - lambda * u;
  const Number of_slope = acoustic ? 6.0 - 2.0 * p - lambda * v : d * d * q / of_w;
  const Number decay = acoustic ? lambda * (6.0 - lambda * k.of_b_and_e) / (2.0 * leading * p)
                                : lambda * (d * d * (2.0 - p) / of_w + e) / (2.0 * leading);
  const Number s = sqrt_of(band == Band::above ? -q : q);
  const Number sinh_phi = sqrt_of(decay * (2.0 + decay));
  WaveOf<Kind> first{s, acoustic ? of_slope : d * s, acoustic ? -d * s : -of_w, {}, {}};
  WaveOf<Kind> second{sinh_phi, of_slope + e * (p + decay), d * sinh_phi, {}, {}};
  if (clamped) {  // no slope, no displacement
    for (WaveOf<Kind>* wave : {&first, &second}) {
      wave->with_sin = wave->slope;
      wave->with_cos = wave->w;
    }
    return {lambda, decay, first, second};
  }
  // No force on, no couple on an element that would go on beyond the end.
  const auto force = [&](const Number& x) {  // -D (F + D cos) - C (B + E cos), x = 1 - cos
    return 12.0 * x + lambda * (0.5 - 6.0 * k.rho + x * (12.0 * (k.of_e - k.of_d) - 2.0 * k.of_c)) -
           lambda * lambda *
               (k.of_d * (k.of_f_and_d - k.of_d * x) + k.of_c * (k.of_b_and_e - k.of_e * x));
  };
  const auto couple = [&](const Number& x) {  // F - D cos
    return 6.0 * x - lambda * (1.0 / 12.0 + k.of_d * x);
  };
  first.with_sin = acoustic ? s * force(p) : force(p) * of_w / d;
  first.with_cos = acoustic ? couple(p) * of_slope - e * d * q : s * (couple(p) * d - e * of_w);
  second.with_sin = -sinh_phi * force(-decay);
  second.with_cos = couple(-decay) * second.w + e * d * sinh_phi * sinh_phi;
  return {lambda, decay, first, second};
}

template WavesOf<One> waves_at<One>(const double&, Band, const Element&, bool);
template WavesOf<Eight> waves_at<Eight>(const Lanes&, Band, const Element&, bool);

double phi_of(const Waves& waves) { return std::log1p(waves.decay + waves.second.turn); }

double largest_decay_felt(double m) {
  const double half = std::sinh(20.0 / m);
  return 2.0 * half * half;
}

}  // namespace subimpact::chain
