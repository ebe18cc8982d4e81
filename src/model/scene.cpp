#include "subimpact/model/scene.h"

#include "numerics/bracketed_root.h"

namespace subimpact {
namespace {

double given(const std::optional<double>& dimension) { return dimension.value_or(0.0); }

}  // namespace

CrossSection::Solid Beam::outer_solid() const {
  if (section.shape == SectionShape::rectangle) {
    return {false, section.height.value_or(thickness), section.width.value_or(width)};
  }
  if (section.diameter) return {true, *section.diameter, *section.diameter};
  return {false, given(section.height), given(section.width)};
}

CrossSection::Solid Beam::gap() const {
  const double wall = given(section.wall);
  switch (section.shape) {
    case SectionShape::tube:
      return {true, given(section.diameter) - 2.0 * wall, given(section.diameter) - 2.0 * wall};
    case SectionShape::box:
      return {false, given(section.height) - 2.0 * wall, given(section.width) - 2.0 * wall};
    case SectionShape::i:
      return {false, given(section.height) - 2.0 * given(section.flange),
              given(section.width) - given(section.web)};
    case SectionShape::rectangle:
    case SectionShape::circle:
      break;
  }
  return {outer_solid().is_round, 0.0, 0.0};
}

double Beam::yield_moment() const {
  const CrossSection::Solid outer = outer_solid();
  if (section.shape == SectionShape::rectangle) {
    return yield_stress * outer.width * outer.height * outer.height / 6.0;
  }
  return yield_stress * second_moment() / (0.5 * outer.height);
}

double Scene::contact_damping() const {
  if (!contact.restitution || *contact.restitution >= 1.0) return contact.damping;
  const double e = *contact.restitution;
  const auto lacking = [e](double z) { return std::log1p(z) - std::log1p(-e * z) - z * (1.0 + e); };
  // The other root is 0; near it the function is (1 - e^2) z^2/2 below it, less (1 + e^3) z^3/3.
  const double near_one = 1.5 * (1.0 - e * e) / (1.0 + e * e * e);
  const double z =
      e > 0.9999 ? near_one : root_in(lacking, 0.3 * std::min(near_one, 1.0), (1.0 - 1e-12) / e);
  return z / bodies().velocity_scale();
}

// Cowper's table. Box and I are thin-walled: h and b between the middles of their walls; m is the
// area of the flanges over that of the webs.
double Beam::used_shear_coefficient() const {
  if (shear_coefficient) return *shear_coefficient;
  const double nu = poisson.value_or(0.0);
  const CrossSection::Solid outer = outer_solid(), inner = gap();
  if (outer.is_round) {
    const double ratio = inner.height / outer.height, q = ratio * ratio;
    return 6.0 * (1.0 + nu) * (1.0 + q) * (1.0 + q) /
           ((7.0 + 6.0 * nu) * (1.0 + q) * (1.0 + q) + (20.0 + 12.0 * nu) * q);
  }
  if (inner.height <= 0.0) return 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
  const bool is_box = section.shape == SectionShape::box;
  const double flange = 0.5 * (outer.height - inner.height), h = outer.height - flange;
  const double webs = outer.width - inner.width, b = outer.width - (is_box ? 0.5 * webs : 0.0);
  const double m = 2.0 * b * flange / (h * webs), m2 = m * m, m3 = m2 * m;
  const double n2 = b / h * (b / h);
  const double of_shape = is_box ? 10.0 * n2 * ((3.0 + nu) * m + 3.0 * m2)
                                 : 30.0 * n2 * (m + m2) + 5.0 * nu * n2 * (8.0 * m + 9.0 * m2);
  return 10.0 * (1.0 + nu) * (1.0 + 3.0 * m) * (1.0 + 3.0 * m) /
         (12.0 + 72.0 * m + 150.0 * m2 + 90.0 * m3 +
          nu * (11.0 + 66.0 * m + 135.0 * m2 + 90.0 * m3) + of_shape);
}

}  // namespace subimpact
