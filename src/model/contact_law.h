#pragma once

#include "subimpact/model/scene.h"

namespace subimpact {

/// K = 4/3 E* sqrt(R) with 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2: the elastic sphere of radius
/// R (m) on an elastic flat (Pa; an infinite modulus is a rigid body), N/m^1.5.
double hertz_stiffness(double radius, double modulus_1, double poisson_1, double modulus_2,
                       double poisson_2);

/// What the contact remembers: the largest indentation it has ever seen (m).
struct ContactHistory {
  double max_indentation = 0.0;
};

/// The pieces of the force-indentation relation; each is smooth on its own.
enum class ContactBranch { separated, elastic, plastic };

/// Force between the striker's nose and the beam's surface, with memory.
///
/// Model: with the indentation `lambda` (m), its largest value so far `lambda_m`, the yield
/// indentation `lambda_s` and the residual indentation `lambda_r = max(lambda_m - lambda_s, 0)`,
/// the force F (N) is
///
///     separated  lambda <= lambda_r                            F = 0
///     elastic    lambda_r < lambda <= max(lambda_m, lambda_s)  F = K [lambda^n - lambda_r^n]
///     plastic    lambda > max(lambda_m, lambda_s), growing     F = K [lambda^n
///                                                                     - (lambda - lambda_s)^n]
///
/// F is continuous; its slope jumps at lambda_r and where unloading begins. The laws of a scene:
///
///     foundation  n = 3/2, K = 4 sqrt(2R) E b/(3h), lambda_s = Y h/E: independent columns of depth
///                 h and modulus E/h, elastic-perfectly plastic at the yield stress Y, pressed by a
///                 rigid cylinder of radius R
///     hertz       n = 3/2, K given or that of a sphere on a flat surface (see hertz_stiffness);
///                 lambda_s infinite
///     linear      n = 1, K given; lambda_s infinite
///
/// Valid while the indentation is small beside R and h.
///
/// The law itself is a value without state: history comes in as an argument and is changed only by
/// `commit`, which callers apply at accepted steps and events, never inside a right-hand side.
///
/// Source: the struck-beam paper's equations (3)-(6), with the radical over 2R alone and the units
/// mended; exact for the columns (the tests compare with a sum over a thousand of them). Hertz
/// (1882), as in K. L. Johnson, Contact Mechanics, section 4.2.
class ContactLaw {
 public:
  /// `stiffness` K > 0 (N/m^n), `exponent` n >= 1, `yield_indentation` lambda_s > 0 (m, may be
  /// infinite). Throws std::invalid_argument otherwise.
  ContactLaw(double stiffness, double exponent, double yield_indentation);

  /// The law of a scene. Throws std::invalid_argument where a constant it needs is missing.
  static ContactLaw of(const Scene& scene);

  double stiffness() const { return stiffness_; }
  double exponent() const { return exponent_; }
  double yield_indentation() const { return yield_indentation_; }

  double residual_indentation(ContactHistory history) const {
    const double residual = history.max_indentation - yield_indentation_;
    return residual > 0.0 ? residual : 0.0;
  }
  /// Indentation above which the contact yields (further).
  double yield_threshold(ContactHistory history) const {
    return history.max_indentation > yield_indentation_ ? history.max_indentation
                                                        : yield_indentation_;
  }

  /// The branch on which `indentation` lies, given the history.
  ContactBranch branch(ContactHistory history, double indentation) const;

  /// Force of the given branch, continued smoothly beyond its range (negative below lambda_r): what
  /// an integrator needs inside a step whose end is then moved to the branch's end.
  double branch_force(ContactBranch branch, ContactHistory history, double indentation) const;

  /// dF/dlambda of the given branch, N/m.
  double branch_slope(ContactBranch branch, ContactHistory history, double indentation) const;

  /// Force of the branch that holds at this indentation.
  double force(ContactHistory history, double indentation) const {
    return branch_force(branch(history, indentation), history, indentation);
  }

  /// The history after the indentation has been reached.
  ContactHistory commit(ContactHistory history, double indentation) const {
    return {indentation > history.max_indentation ? indentation : history.max_indentation};
  }

  /// Work the contact would give back on unloading from here, J.
  double recoverable_energy(ContactHistory history, double indentation) const;

  /// The largest indentation (m) that work `energy` (J) can press into the surface.
  double indentation_at(double energy) const;
  /// The largest slope dF/dlambda (N/m) that any history can show up to an indentation: that of
  /// unloading from there.
  double largest_slope(double indentation) const { return stiffness_ * power_slope(indentation); }

  /// Work that plastic indentation has consumed so far: K lambda_r^n lambda_s for n = 3/2, J.
  double dissipated_energy(ContactHistory history) const;

 private:
  double power(double indentation) const;           // signed lambda^n
  double power_slope(double indentation) const;     // its derivative
  double power_integral(double indentation) const;  // its integral from zero

  double stiffness_;
  double exponent_;
  double yield_indentation_;
};

}  // namespace subimpact
