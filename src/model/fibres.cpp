#include "subimpact/model/fibres.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace subimpact {
namespace {

bool is_positive(double x) { return x > 0.0 && std::isfinite(x); }

void check(const FibreStrip& strip) {
  if (!(strip.from >= 0.0 && strip.from < strip.to && strip.to <= 1.0)) {
    throw std::invalid_argument("section of strips: distances must rise and lie within 0 to 1");
  }
  if (!is_positive(strip.width) || !is_positive(strip.modulus) || !is_positive(strip.yield)) {
    throw std::invalid_argument(
        "section of strips: width, modulus and yield stress must be positive and finite");
  }
}

}  // namespace

Fibres Fibres::continuous() { return Fibres(0); }

Fibres Fibres::layered(int layers) {
  if (layers < 2 || layers % 2 != 0) {
    throw std::invalid_argument("layered section: the number of layers must be even and positive");
  }
  return Fibres(layers / 2);
}

Fibres::Fibres(int half_layers)
    : half_layers_(half_layers), whole_{}, name_(half_layers == 0 ? "exact" : "layers") {
  outermost_ = half_layers == 0 ? 1.0 : (half_layers_ - 0.5) / half_layers_;
  first_yield_ = 1.0 / outermost_;
  whole_ = up_to(1.0);
  slope_ = 3.0 * whole_.s2;
}

Fibres Fibres::strips(std::vector<FibreStrip> strips, std::string name) {
  if (strips.empty()) throw std::invalid_argument("section of strips: there are none");
  std::vector<Band> bands;
  double extent = 0.0;
  const FibreStrip* outer = &strips.front();
  for (const FibreStrip& strip : strips) {
    check(strip);
    const double per_distance = strip.modulus / strip.yield;  // zeta over distance
    const double weight = strip.width * strip.yield * strip.yield / strip.modulus / per_distance;
    bands.push_back({per_distance * strip.from, per_distance * strip.to, weight});
    extent = std::max(extent, bands.back().to);
    if (strip.to > outer->to) outer = &strip;
  }
  Fibres fibres(std::move(bands), extent);
  fibres.outermost_ = outer->to * outer->modulus / outer->yield;
  fibres.outer_yield_ = outer->yield;
  fibres.outer_modulus_ = outer->modulus;
  fibres.name_ = std::move(name);
  return fibres;
}

Fibres::Fibres(std::vector<Band> bands, double extent)
    : half_layers_(-1.0),
      bands_(std::move(bands)),
      whole_(of_bands_up_to(extent)),
      slope_(3.0 * whole_.s2),
      first_yield_(1.0 / extent),
      outermost_(extent),
      extent_(extent) {}

// Not inlined into up_to, which is small enough to be inlined without it: energies cost half more.
[[gnu::noinline]] Fibres::Moments Fibres::of_bands_up_to(double zeta) const {
  Moments sum{};
  for (const Band& band : bands_) {
    const double a = band.from;
    const double b = std::min(zeta, band.to);
    if (!(b > a)) continue;
    sum.s0 += band.weight * (b - a);
    sum.s1 += band.weight * 0.5 * (b * b - a * a);
    sum.s2 += band.weight * (b * b * b - a * a * a) / 3.0;
  }
  return sum;
}

Fibres::Moments Fibres::up_to(double zeta) const {
  if (half_layers_ == 0.0) {
    const double z = std::min(zeta, 1.0);
    return {z, 0.5 * z * z, z * z * z / 3.0};
  }
  if (half_layers_ < 0.0) return of_bands_up_to(zeta);
  const double p = half_layers_;
  const double n = std::min(std::floor(p * zeta + 0.5), p);  // layers at or below zeta
  return {n / p, 0.5 * n * n / (p * p), n * (4.0 * n * n - 1.0) / (12.0 * p * p * p)};
}

Fibres::Response Fibres::response(double x) const {
  const double size = std::abs(x);
  if (size <= first_yield_) return {slope_ * x, 0.5 * slope_ * x * x};
  const Moments elastic = up_to(1.0 / size);
  return {std::copysign(3.0 * (size * elastic.s2 + whole_.s1 - elastic.s1), x),
          3.0 * (0.5 * size * size * elastic.s2 + size * (whole_.s1 - elastic.s1) -
                 0.5 * (whole_.s0 - elastic.s0))};
}

double Fibres::moment(double x) const { return response(x).moment; }

double Fibres::tangent(double x) const {
  const double size = std::abs(x);
  return size <= first_yield_ ? slope_ : 3.0 * up_to(1.0 / size).s2;
}

double Fibres::work(double x) const { return response(x).work; }

double Fibres::energy(double a, double b, double constant, double slope) const {
  const Moments lower = up_to(a);
  const Moments upper = up_to(b);
  return 1.5 *
         (constant * constant * (upper.s0 - lower.s0) +
          2.0 * constant * slope * (upper.s1 - lower.s1) + slope * slope * (upper.s2 - lower.s2));
}

}  // namespace subimpact
