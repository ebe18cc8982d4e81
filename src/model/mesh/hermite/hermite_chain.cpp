#include "model/mesh/hermite/hermite_chain.h"

#include <algorithm>
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

namespace {

std::size_t held(EndSupport end) {
  return end == EndSupport::free ? 0 : end == EndSupport::pinned ? 1 : 2;
}

Lanes powers_of(double step) {
  Lanes values{};
  double power = 1.0;
  for (std::size_t i = 0; i < n_lanes; ++i, power *= step) values[i] = power;
  return values;
}

// Adds w cosh(phi d)/cosh(phi m), slope sinh(phi d)/cosh(phi m), or sinh and cosh in an odd mode;
// `step` is e^-phi, `full` e^-2 phi m.
void add_decaying(double w, double slope, double step, double full, bool even, Columns& to) {
  constexpr double negligible = 1e-30;
  const double norm = 1.0 / (1.0 + full);
  (even ? slope : w) *= norm;
  (even ? w : slope) *= norm;
  Lanes near = powers_of(step);
  const double group = near[n_lanes - 1] * step;
  for (std::size_t i = 0; i < to.w.size() && near[0] > negligible; i += n_lanes) {
    store(lanes_at(&to.w[i]) + w * near, &to.w[i]);
    store(lanes_at(&to.slope[i]) + slope * near, &to.slope[i]);
    near *= group;
  }
  if (full < negligible) return;
  (even ? slope : w) *= -1.0;
  Lanes far = full * powers_of(1.0 / step);
  for (std::size_t i = 0; i < to.w.size(); i += n_lanes) {
    store(lanes_at(&to.w[i]) + w * far, &to.w[i]);
    store(lanes_at(&to.slope[i]) + slope * far, &to.slope[i]);
    far *= 1.0 / group;
  }
}

void fill_inwards(const Mode& mode, double m, double largest_decay, Columns& to) {
  const bool even = mode.parity == Parity::even;
  const Wave& first = mode.waves.first;
  const Wave& second = mode.waves.second;
  if (mode.band == Band::above) {
    std::fill(to.w.begin(), to.w.end(), 0.0);
    std::fill(to.slope.begin(), to.slope.end(), 0.0);
    add_decaying(first.w, first.slope, std::exp(-mode.number), std::exp(-2.0 * mode.number * m),
                 even, to);
  } else {
    Lanes d{};
    for (std::size_t i = 0; i < n_lanes; ++i) d[i] = m - static_cast<double>(i);
    const SinCos start = sin_cos(mode.number * d);
    const double turn = static_cast<double>(n_lanes) * mode.number;
    const double cosine = std::cos(turn);
    const double sine = std::sin(turn);
    Lanes w = even ? start.cosine : start.sine;
    Lanes slope = even ? start.sine : -start.cosine;
    for (std::size_t i = 0; i < to.w.size(); i += n_lanes) {
      store(first.w * w, &to.w[i]);
      store(first.slope * slope, &to.slope[i]);
      const Lanes turned = w * cosine + slope * sine;
      slope = slope * cosine - w * sine;
      w = turned;
    }
  }
  const double step = 1.0 / (1.0 + mode.waves.decay + second.turn);
  const double full =
      mode.waves.decay > largest_decay ? 0.0 : std::exp(-2.0 * m * phi_of(mode.waves));
  add_decaying(mode.second * second.w, mode.second * second.slope, step, full, even, to);
}

}  // namespace

Shapes::Shapes(const HermiteChain& chain, bool about_last, bool about_first)
    : n_nodes_((chain.half ? chain.n_elements / 2 : chain.n_elements) + 1),
      one_sided_(chain.half || about_last || about_first),
      backwards_(about_first),
      first_(held(chain.ends[0])),
      last_(chain.half ? 0 : held(chain.ends[1])),
      half_(chain.half),
      n_inwards_(one_sided_ ? n_nodes_ : (n_nodes_ + 1) / 2),
      inwards_(n_inwards_),
      largest_decay_(largest_decay_felt(m())),
      nodal_(2 * n_nodes_) {}

double Shapes::m() const {
  const double n = static_cast<double>(n_nodes_ - 1);
  return one_sided_ ? n : 0.5 * n;
}

std::size_t Shapes::n_unknowns() const { return 2 * n_nodes_ - first_ - last_ - (half_ ? 1 : 0); }

void Shapes::write(const Mode& mode, double* shape) {
  fill_inwards(mode, m(), largest_decay_, inwards_);
  write(mode.parity, shape);
}

void Shapes::write_rigid(Parity parity, double* shape) {
  for (std::size_t i = 0; i < n_inwards_; ++i) {
    const double d = m() - static_cast<double>(i);
    inwards_.w[i] = parity == Parity::even ? 1.0 : d;
    inwards_.slope[i] = parity == Parity::even ? 0.0 : 1.0;
  }
  write(parity, shape);
}

void Shapes::write(Parity parity, double* shape) {
  const std::size_t n = n_nodes_;
  const double sign = parity == Parity::even ? 1.0 : -1.0;
  const double* w = inwards_.w.data();
  const double* slope = inwards_.slope.data();
  if (!backwards_) {
    for (std::size_t i = 0; i < n_inwards_; ++i) {
      nodal_[2 * i] = w[i];
      nodal_[2 * i + 1] = -slope[i];
    }
  }
  const std::size_t n_mirrored = one_sided_ && !backwards_ ? 0 : backwards_ ? n : n / 2;
  for (std::size_t i = 0; i < n_mirrored; ++i) {
    nodal_[2 * (n - 1 - i)] = sign * w[i];
    nodal_[2 * (n - 1 - i) + 1] = sign * slope[i];
  }
  const auto values = nodal_.begin() + static_cast<std::ptrdiff_t>(first_);
  double* end = std::copy(values, nodal_.end() - (last_ > 0 ? 2 : half_ ? 1 : 0), shape);
  if (last_ == 1) *end = nodal_.back();
}

}  // namespace subimpact::chain
