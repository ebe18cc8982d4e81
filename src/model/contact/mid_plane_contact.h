#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "model/contact/curves/mean_pressure.h"
#include "model/contact/curves/start_table.h"
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
/// half width a of the contact, whose area is A:
///
///     elastic     F = k a^n,               lambda = a^2/(2 R) + c(a) F
///     plastic     F = A(a) p_m(a),         lambda = a^2/(2 R) + c(a) F
///     unloading   F = k_m a^n,             lambda = lambda_r + k_m/k a^2/(2 R) + c(a) F,
///                 k_m = F_m/a_m^n,         lambda_r = (1 - k_m/k) a_m^2/(2 R)
///
/// c(a) F is what the surface gives way beside its shape, at the middle of the contact, less what
/// the mid-plane does. A pressed-in nose has a^2 = 2 R lambda, less what springs back; a contact
/// that unloads is elastic with the radius R k/k_m of the dent. Force, slope of the loading curve
/// and indentation are continuous. Energies are integrals in a, exact to rounding.
class MidPlaneContact final : public ContactLaw {
 public:
  /// Without a pressure the contact never yields.
  MidPlaneContact(std::string name, NoseOnBeam nose, std::optional<MeanPressure> pressure);

  std::string name() const override { return name_; }
  ContactScales scales() const override;
  double residual_indentation(ContactHistory history) const override;
  double yield_threshold(ContactHistory history) const override;
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

}  // namespace subimpact
