#include "model/fibres.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace subimpact {

Fibres Fibres::continuous() { return Fibres(0); }

Fibres Fibres::layered(int layers) {
  if (layers < 2 || layers % 2 != 0) {
    throw std::invalid_argument("layered section: the number of layers must be even and positive");
  }
  return Fibres(layers / 2);
}

Fibres::Fibres(int half_layers) : half_layers_(half_layers), whole_{} {
  outermost_ = half_layers == 0 ? 1.0 : (half_layers_ - 0.5) / half_layers_;
  first_yield_ = 1.0 / outermost_;
  whole_ = up_to(1.0);
  slope_ = 3.0 * whole_.s2;
}

Fibres::Moments Fibres::up_to(double zeta) const {
  if (half_layers_ == 0.0) {
    const double z = std::min(zeta, 1.0);
    return {z, 0.5 * z * z, z * z * z / 3.0};
  }
  const double p = half_layers_;
  const double n = std::min(std::floor(p * zeta + 0.5), p);  // layers at or below zeta
  return {n / p, 0.5 * n * n / (p * p), n * (4.0 * n * n - 1.0) / (12.0 * p * p * p)};
}

double Fibres::moment(double x) const {
  const double size = std::abs(x);
  if (size <= first_yield_) return slope_ * x;
  const Moments elastic = up_to(1.0 / size);
  return std::copysign(3.0 * (size * elastic.s2 + whole_.s1 - elastic.s1), x);
}

double Fibres::tangent(double x) const {
  const double size = std::abs(x);
  return size <= first_yield_ ? slope_ : 3.0 * up_to(1.0 / size).s2;
}

double Fibres::work(double x) const {
  const double size = std::abs(x);
  if (size <= first_yield_) return 0.5 * slope_ * x * x;
  const Moments elastic = up_to(1.0 / size);
  return 3.0 * (0.5 * size * size * elastic.s2 + size * (whole_.s1 - elastic.s1) -
                0.5 * (whole_.s0 - elastic.s0));
}

double Fibres::energy(double a, double b, double constant, double slope) const {
  const Moments lower = up_to(a);
  const Moments upper = up_to(b);
  return 1.5 *
         (constant * constant * (upper.s0 - lower.s0) +
          2.0 * constant * slope * (upper.s1 - lower.s1) + slope * slope * (upper.s2 - lower.s2));
}

}  // namespace subimpact
