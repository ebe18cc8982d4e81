#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "subimpact/model/contact_law.h"
#include "subimpact/model/scene.h"

namespace subimpact {

/// 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2, 1/Pa; an infinite modulus is a rigid body.
double contact_compliance(double modulus_1, double poisson_1, double modulus_2, double poisson_2);

/// Radii (m) of the gap between two surfaces that touch, along the beam and across it; infinite
/// where the gap is straight.
struct GapRadii {
  double along, across;
};
/// Radii of the gap between the nose (its radius is needed) and the struck surface, flat or round.
GapRadii gap_radii(const Scene& scene);

/// K (N/m^1.5) of Hertz's contact of finite radii: 4/3 E* sqrt(R) where they are equal; otherwise
/// the surfaces touch in an ellipse. Source: K. L. Johnson, Contact Mechanics, equations 4.25-4.28.
double hertz_stiffness(GapRadii radii, double compliance);

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
               std::string name = "power law");

  double stiffness() const { return stiffness_; }
  double exponent() const { return exponent_; }
  double yield_indentation() const { return yield_indentation_; }

  std::string name() const override { return name_; }
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
};

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

struct ContactConstants {
  std::span<const char* const> keys;  ///< of the case file, all needed
  const char* remedy;                 ///< where one is missing
  /// Why a constant of the contact that is not among the keys has no use.
  const char* why_unused;
  /// Keys that may be given as well.
  std::span<const char* const> optional = {};
};

/// A contact law that a scene can name (docs/theory.md, "Contact"). A new one is a class of its
/// own, an enumerator and a row of built_in_contact_laws().
struct BuiltInContactLaw {
  ContactKind kind;
  const char* name;
  const char* note;
  bool yields;
  /// The ways to give its constants; the last one is assumed where none is complete.
  std::span<const ContactConstants> ways;
  /// Throws std::invalid_argument where a constant is missing.
  std::shared_ptr<const ContactLaw> (*make)(const Scene& scene);
  /// Why the law does not describe the nose on the beam's section; empty where it does. The radii
  /// of the gap are NaN without a nose radius.
  std::string (*why_not)(const Scene& scene, GapRadii radii) = nullptr;
};

std::span<const BuiltInContactLaw> built_in_contact_laws();
const BuiltInContactLaw& built_in_contact_law(ContactKind kind);

/// The law that a scene names. Throws std::invalid_argument where a constant is missing.
std::shared_ptr<const ContactLaw> make_contact_law(const Scene& scene);

/// Largest contact pressure over yield stress at which metals yield under a sphere.
inline constexpr double yield_pressure_over_stress = 1.6;

/// The velocity (m/s) from which a strike yields the contact of a beam that does not give way, so
/// that any slower strike leaves it elastic: that of the law; of an elastic Hertz contact with a
/// nose radius that of its material. Nothing where nothing yields or too little is given.
std::optional<double> contact_yield_velocity(const Scene& scene, const ContactLaw& law);

}  // namespace subimpact
