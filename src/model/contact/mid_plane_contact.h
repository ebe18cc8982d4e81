#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "model/contact/curves.h"
#include "subimpact/model/contact/contact_law.h"

namespace subimpact {

/// A round nose on a beam's surface, as MidPlaneContact needs it.
struct NoseOnBeam {
  int order;         ///< n: of a ball 3, of a line 2
  double radius;     ///< R, m
  double stiffness;  ///< k, N/m^n
  double area;       ///< A/a^(n - 1)
  double widest;     ///< m, largest half width that the law describes
  std::function<ValueAndSlope(double)> compliance;  ///< c (m/N), dc/da for a > 0
};

/// A round nose on a beam, its indentation lambda measured from the mid-plane: the displacement of
/// the nose minus that of the beam's axis, as the equations of motion have it. Closed forms in the
/// half width a of the contact (docs/theory/contact.md, "From mid-plane and half-space"): c(a) F is
/// what the surface gives way beside its shape, at the middle of the contact, less what the
/// mid-plane does; a contact that unloads is elastic with the radius R k/k_m of the dent. Force,
/// slope of the loading curve and indentation are continuous.
class MidPlaneContact final : public ContactLaw {
 public:
  /// Without a pressure the contact never yields.
  MidPlaneContact(std::string name, NoseOnBeam nose, std::optional<MeanPressure> pressure);

  std::string name() const override { return name_; }
  ContactScales scales() const override;
  double residual_indentation(ContactHistory history) const override {
    return dent_of(history).residual;
  }
  double yield_threshold(ContactHistory history) const override {
    return std::max(history.max_indentation, first_yield_);
  }
  double force(ContactHistory history, double indentation) const override;
  double slope(ContactHistory history, double indentation) const override;
  double plastic_force(double indentation) const override;
  double plastic_slope(double indentation) const override;
  double recoverable_energy(ContactHistory history, double indentation) const override;
  double dissipated_energy(ContactHistory history) const override;
  double largest_slope(double indentation) const override;
  double largest_indentation() const override;

  /// Half width (m) of a first loading at an indentation above 0.
  double half_width_at(double indentation) const;

 private:
  struct Dent {
    double stiffness, residual;  // k_m, lambda_r
  };
  Dent dent_of(ContactHistory history) const;
  double half_width_of(const Dent& dent, double indentation) const;
  double power(double half_width) const;  // a^n
  ValueAndSlope elastic_force(double stiffness, double half_width) const;
  ValueAndSlope loading_force(double half_width) const;
  // share a^2/(2 R) + c(a) F
  ValueAndSlope indentation(double half_width, double share, ValueAndSlope force) const;
  ValueAndSlope elastic_indentation(double stiffness, double half_width) const;
  double elastic_energy(double stiffness, double half_width) const;

  std::string name_;
  NoseOnBeam nose_;
  std::optional<MeanPressure> pressure_;
  double first_yield_;                          // m, an indentation
  StartTable elastic_starts_, plastic_starts_;  // of half widths, below and above first yield
  std::uint64_t serial_;                        // of this law, among all
};

struct BodiesOfBall {
  double radius, depth;     ///< R, d, m
  double beam_modulus;      ///< E, Pa
  double beam_poisson;      ///< nu
  double modulus;           ///< E* of both, Pa
  double of_ellipse = 1.0;  ///< F_2: approach over that of a circle, under the same force
};

/// A ball on a beam, valid up to a = d, or on a half-space (infinite d). What a half-space moves at
/// the depth d under Hertz's pressure is no indentation but belongs to the beam: under a rigid
/// ball, for small a, the share 4/3 (3 - 2 nu)/(2 pi (1 - nu)) a/d of Hertz's.
///
/// A touch in an ellipse counts as one in a circle of the same area, with the elastic stiffness of
/// the ellipse. For mild ones: pressures are 2 % off where one radius is twice the other, a tenth
/// where it is five times the other. Source: K. L. Johnson, Contact Mechanics, sections 3.2, 4.2
/// and 6.3.
NoseOnBeam ball_on_beam(const BodiesOfBall& bodies);

struct BodiesOfLine {
  double radius, width, depth;  ///< R, b, d, m
  double beam_modulus;          ///< E_1* = E_1/(1 - nu_1^2), Pa
  double beam_poisson;          ///< nu_1
  double nose_modulus;          ///< E_2*, Pa; infinite: rigid
};

/// A cylinder across a beam, which touches it along a line, in plane strain: for noses much longer
/// than the contact is wide. Of F/(pi E* b) the indentation has a^2/(2 R), -2 of the shape under
/// Hertz's pressure, and what beam and nose give way down to the mid-plane and up to the middle of
/// the nose, as the approach of points far away is infinite. Valid while all but the first exceed
/// 1/2. Source: K. L. Johnson, Contact Mechanics, equations 4.43, 4.45, 5.57 and 5.58, of which a
/// nose has half: a cylinder between two plates.
NoseOnBeam cylinder_across(const BodiesOfLine& bodies);

}  // namespace subimpact
