#include "subimpact/model/section/fibres.h"

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

Fibres Fibres::continuous(const Beam& beam) {
  if (beam.section.shape == SectionShape::rectangle) return Fibres(0);
  const CrossSection::Solid outer = beam.outer_solid(), gap = beam.gap();
  const double height = outer.height;
  const auto weight = [&](double width) {
    return width * height * height * height / (12.0 * beam.second_moment());
  };
  std::vector<Band> bands{{0.0, 1.0, weight(outer.width), outer.is_round}};
  const double inner = gap.height / height;
  if (inner > 0.0 && outer.is_round) bands.push_back({0.0, inner, -weight(gap.width), true});
  if (inner > 0.0 && !outer.is_round) {  // without cancellation: the webs, then the flanges
    bands = {{0.0, inner, weight(outer.width - gap.width)}, {inner, 1.0, weight(outer.width)}};
  }
  Fibres fibres(std::move(bands), 1.0);
  fibres.name_ = "exact";
  return fibres;
}

Fibres Fibres::layered(int layers, const Beam& beam) {
  if (layers < 2 || layers % 2 != 0) {
    throw std::invalid_argument("layered section: the number of layers must be even and positive");
  }
  Fibres fibres(layers / 2);
  if (beam.section.shape != SectionShape::rectangle) fibres.tabulate_layers(continuous(beam));
  return fibres;
}

// Each layer has the area of the section between its faces.
void Fibres::tabulate_layers(const Fibres& exact) {
  Moments sum{};
  of_layers_ = {sum};
  for (double k = 0.0; k < half_layers_; k += 1.0) {
    const double weight =
        exact.up_to((k + 1.0) / half_layers_).s0 - exact.up_to(k / half_layers_).s0;
    const double zeta = (k + 0.5) / half_layers_;
    sum = {sum.s0 + weight, sum.s1 + weight * zeta, sum.s2 + weight * zeta * zeta};
    of_layers_.push_back(sum);
  }
  whole_ = sum;
  slope_ = 3.0 * sum.s2;
}

Fibres Fibres::hardened(double h) const {
  if (!(h >= 0.0 && h < 1.0)) {
    throw std::invalid_argument("section: the share of stiffness after yield must be from 0 to 1");
  }
  Fibres fibres = *this;
  if (h == 0.0) return fibres;
  fibres.hardening_ = h;
  fibres.never_yields_ = h * slope_ / 3.0;
  if (half_layers_ == 0.0) {
    fibres.half_layers_ = -1.0;
    fibres.bands_ = {{0.0, 1.0, 1.0}};
  } else if (half_layers_ > 0.0 && of_layers_.empty()) {
    fibres.tabulate_layers(continuous());
  }
  for (Band& band : fibres.bands_) band.weight *= 1.0 - h;
  for (Moments& m : fibres.of_layers_) {
    m = {(1.0 - h) * m.s0, (1.0 - h) * m.s1, (1.0 - h) * m.s2 + fibres.never_yields_};
  }
  fibres.whole_ = fibres.up_to(extent_);
  return fibres;
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
  Moments sum{0.0, 0.0, never_yields_};
  for (const Band& band : bands_) {
    if (band.is_round) {
      const double r = band.to, s = std::min(zeta / r, 1.0), root = std::sqrt(1.0 - s * s);
      const double w = band.weight * r, angle = std::asin(s);
      sum.s0 += 0.5 * w * (angle + s * root);
      sum.s1 += w * r * (1.0 - root * root * root) / 3.0;
      sum.s2 += 0.125 * w * r * r * (angle - s * (1.0 - 2.0 * s * s) * root);
      continue;
    }
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
  if (!of_layers_.empty()) return of_layers_[static_cast<std::size_t>(n)];
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

double Fibres::tangent(double x) const {
  const double size = std::abs(x);
  return size <= first_yield_ ? slope_ : 3.0 * up_to(1.0 / size).s2;
}

double Fibres::energy(double a, double b, double constant, double slope) const {
  const Moments lower = a > 0.0 ? up_to(a) : Moments{};
  const Moments upper = up_to(b);
  return 1.5 *
         (constant * constant * (upper.s0 - lower.s0) +
          2.0 * constant * slope * (upper.s1 - lower.s1) + slope * slope * (upper.s2 - lower.s2));
}

}  // namespace subimpact
