#include "model/hermite_chain_shapes.h"

#include <algorithm>
#include <cmath>

#include "numerics/lanes.h"
#include "numerics/sin_cos.h"

namespace subimpact::chain {
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
