#pragma once

#include <limits>
#include <string>
#include <vector>

#include "model/contact/curves.h"
#include "subimpact/model/contact/contact_law.h"

namespace subimpact {

/// Points (m, N) of a measured force over indentation, in the order of rising indentation; the
/// first may be (0, 0), which is added where it is missing.
struct MeasuredCurve {
  std::vector<double> indentations, forces;
};

/// A contact as measured: the first loading follows F(lambda), a MonotoneCurve through its points,
/// up to the last one, lambda_1. Without a curve of unloading the contact is elastic. With one,
/// from the residual indentation rho lambda_1 up to the last point of loading, unloading and
/// reloading from any largest indentation lambda_m follow the same curve to scale,
///
///     F(lambda_m) psi(s),  s = (lambda - rho lambda_m)/((1 - rho) lambda_m),
/// with psi(s) the measured unloading over F(lambda_1). Energies are exact integrals of the curves.
/// Valid up to lambda_1, for velocities at which the curve was measured.
class CurveContact final : public ContactLaw {
 public:
  /// `unloading` may be empty. Throws std::invalid_argument with fault_of() the curves.
  CurveContact(const MeasuredCurve& loading, const MeasuredCurve& unloading);

  std::string name() const override { return "curve"; }
  double force(ContactHistory history, double indentation) const override;
  double residual_indentation(ContactHistory history) const override {
    return residual_share_ * history.max_indentation;
  }
  double yield_threshold(ContactHistory history) const override {
    return yields_ ? history.max_indentation : std::numeric_limits<double>::infinity();
  }
  ContactScales scales() const override;
  double slope(ContactHistory history, double indentation) const override;
  double plastic_force(double indentation) const override { return loading_.value(indentation); }
  double plastic_slope(double indentation) const override { return loading_.slope(indentation); }
  double recoverable_energy(ContactHistory history, double indentation) const override;
  double dissipated_energy(ContactHistory history) const override;
  double largest_slope(double indentation) const override;
  double largest_indentation() const override { return last_; }
  Limit limit() const override { return Limit::last_point; }

 private:
  // Unloading from lambda_m: its length, and the place of an indentation on it.
  double length(double largest) const { return (1.0 - residual_share_) * largest; }
  double place(double largest, double indentation) const {
    return (indentation - residual_share_ * largest) / length(largest);
  }

  MonotoneCurve loading_, unloading_;  // of unloading: psi(s)
  double last_ = 0.0;
  double residual_share_ = 0.0;  // rho
  bool yields_ = false;
};

/// What keeps two curves from being those of a contact, as the end of a sentence that begins with
/// their keys; empty if nothing does.
std::string fault_of(const MeasuredCurve& loading, const MeasuredCurve& unloading);

}  // namespace subimpact
