#pragma once

#include <string>

#include "subimpact/model/contact/contact_law.h"

namespace subimpact {

/// A sphere that yields, or is pressed into a surface that does: Hertz's law up to the indentation
/// delta_y; then the pressure is cut off at p_y over the growing contact, and unloading is Hertz's
/// again with the radius of the dent. With a of the contact circle and F_m, delta_m at the deepest
/// point,
///
///     delta_y = (pi p_y/(2 E*))^2 R,   F_y = 4/3 E* sqrt(R) delta_y^1.5
///     loading     F = F_y + pi p_y R (delta - delta_y)
///     unloading   F = F_m (1 - (delta_m - delta)/d)^1.5,   d = 3 F_m/(4 E* a),
///                 a^2 = (2 F_m + F_y)/(2 pi p_y)
///
/// Valid for dents small compared with R, between fully elastic and fully plastic pressure. Source:
/// C. Thornton, Coefficient of restitution for collinear collisions of elastic-perfectly plastic
/// spheres, J. Appl. Mech. 64 (1997) 383.
class SphereContact final : public ContactLaw {
 public:
  /// R (m), E* (Pa), p_y (Pa), positive and finite; throws std::invalid_argument otherwise.
  SphereContact(double radius, double modulus, double yield_pressure);

  std::string name() const override { return "sphere"; }
  ContactScales scales() const override;
  double residual_indentation(ContactHistory history) const override;
  double yield_threshold(ContactHistory history) const override;
  double force(ContactHistory history, double indentation) const override;
  double slope(ContactHistory history, double indentation) const override;
  double plastic_force(double indentation) const override;
  double plastic_slope(double) const override { return plastic_stiffness_; }

 private:
  // The unloading curve: its largest force, its length d and the residual indentation.
  struct Unloading {
    double force, length, residual;
  };
  Unloading unloading(ContactHistory history) const;

  double modulus_, pressure_;
  double yield_indentation_, yield_force_, plastic_stiffness_;
};

}  // namespace subimpact
