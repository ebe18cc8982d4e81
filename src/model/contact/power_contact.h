#pragma once

#include <algorithm>
#include <string>

#include "subimpact/model/contact/contact_law.h"

namespace subimpact {

/// A power of the indentation, with or without yielding.
///
/// The branches are those of docs/theory.md, "Contact", with the exponent n in place of 1.5. Valid
/// while the indentation is small compared with the nose's radius and the beam's thickness.
///
/// Source: the struck-beam paper's equations (3)-(6), with the radical over 2R alone and the units
/// mended; exact for the columns (the tests compare with a sum over a thousand of them), also under
/// a nose that is round both ways, where n = 2 and K = pi sqrt(R_1 R_2) E/h. Hertz
/// (1882), as in K. L. Johnson, Contact Mechanics, section 4.2.
class PowerContact final : public ContactLaw {
 public:
  /// `stiffness` K > 0 (N/m^n), `exponent` n >= 1, `yield_indentation` lambda_s > 0 (m, may be
  /// infinite). Throws std::invalid_argument otherwise.
  PowerContact(double stiffness, double exponent, double yield_indentation,
               std::string name = "power law", Limit limit = Limit::width);

  double yield_indentation() const { return yield_indentation_; }

  std::string name() const override { return name_; }
  Limit limit() const override { return limit_; }
  ContactScales scales() const override { return {stiffness_, exponent_}; }
  double residual_indentation(ContactHistory history) const override {
    const double residual = history.max_indentation - yield_indentation_;
    return residual > 0.0 ? residual : 0.0;
  }
  double yield_threshold(ContactHistory history) const override {
    return history.max_indentation > yield_indentation_ ? history.max_indentation
                                                        : yield_indentation_;
  }
  double force(ContactHistory history, double indentation) const override;
  double slope(ContactHistory history, double indentation) const override;
  double plastic_force(double indentation) const override;
  double plastic_slope(double indentation) const override;
  double recoverable_energy(ContactHistory history, double indentation) const override;
  /// K lambda_r^n lambda_s for n = 3/2.
  double dissipated_energy(ContactHistory history) const override;

 private:
  double power(double indentation) const;           // signed lambda^n
  double power_slope(double indentation) const;     // its derivative
  double power_integral(double indentation) const;  // its integral from zero

  double stiffness_;
  double exponent_;
  double yield_indentation_;
  std::string name_;
  Limit limit_;
};

/// A sphere that yields, or is pressed into a surface that does (docs/theory/contact.md,
/// "Contact"): Hertz's law up to the indentation delta_y; then the pressure is cut off at p_y over
/// the growing contact, and unloading is Hertz's again with the radius of the dent. Valid for dents
/// small compared with R, between fully elastic and fully plastic pressure. Source: C. Thornton,
/// Coefficient of restitution for collinear collisions of elastic-perfectly plastic spheres, J.
/// Appl. Mech. 64 (1997) 383.
class SphereContact final : public ContactLaw {
 public:
  /// R (m), E* (Pa), p_y (Pa), positive and finite; throws std::invalid_argument otherwise.
  SphereContact(double radius, double modulus, double yield_pressure);

  std::string name() const override { return "sphere"; }
  ContactScales scales() const override;
  double residual_indentation(ContactHistory history) const override {
    return unloading(history).residual;
  }
  double yield_threshold(ContactHistory history) const override {
    return std::max(history.max_indentation, yield_indentation_);
  }
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
