#pragma once

#include <memory>
#include <span>
#include <string>

#include "subimpact/model/contact_law.h"
#include "subimpact/model/scene.h"

namespace subimpact {

/// K = 4/3 E* sqrt(R) with 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2: the elastic sphere of radius
/// R (m) on an elastic flat (Pa; an infinite modulus is a rigid body), N/m^1.5.
double hertz_stiffness(double radius, double modulus_1, double poisson_1, double modulus_2,
                       double poisson_2);

/// A power of the indentation, with or without yielding: all laws that a case file can name.
///
/// The branches are those of docs/theory.md, "Contact", with the exponent n in place of 1.5. Valid
/// while the indentation is small beside the nose's radius and the beam's thickness.
///
/// Source: the struck-beam paper's equations (3)-(6), with the radical over 2R alone and the units
/// mended; exact for the columns (the tests compare with a sum over a thousand of them). Hertz
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
  double elastic_force(ContactHistory history, double indentation) const override;
  double elastic_slope(ContactHistory history, double indentation) const override;
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

struct ContactConstants {
  std::span<const char* const> keys;  ///< of the case file, all needed
  const char* remedy;                 ///< where one is missing
  /// Why a constant of the contact that is not among the keys has no use.
  const char* why_unused;
};

/// A contact law that a scene can name (docs/theory.md, "Contact"): a PowerContact of n = 3/2
/// (foundation, hertz) or 1 (linear). A new one is a class of its own, an enumerator and a row of
/// built_in_contact_laws().
struct BuiltInContactLaw {
  ContactKind kind;
  const char* name;
  const char* note;
  /// The ways to give its constants; the last one is assumed where none is complete.
  std::span<const ContactConstants> ways;
  /// Throws std::invalid_argument where a constant is missing.
  std::shared_ptr<const ContactLaw> (*make)(const Scene& scene);
};

std::span<const BuiltInContactLaw> built_in_contact_laws();
const BuiltInContactLaw& built_in_contact_law(ContactKind kind);

/// The law that a scene names. Throws std::invalid_argument where a constant is missing.
std::shared_ptr<const ContactLaw> make_contact_law(const Scene& scene);

}  // namespace subimpact
