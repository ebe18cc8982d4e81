#pragma once

#include <limits>
#include <optional>
#include <string>

namespace subimpact {

/// The history of the contact: its largest indentation so far (m).
struct ContactHistory {
  double max_indentation = 0.0;
};

/// The pieces of the force-indentation relation; each is smooth on its own.
enum class ContactBranch {
  separated,  ///< no force
  elastic,    ///< unloading and reloading, reversible
  plastic     ///< virgin loading: the indentation grows beyond all earlier ones
};

/// The power law K lambda^n of a contact that closes for the first time. It need not be exact: only
/// time scales and tolerances of the run follow from it.
struct ContactScales {
  double stiffness;  ///< K, N/m^n
  double exponent;   ///< n, at least 1
};

/// Force F (N) between the striker's nose and the beam's surface as a function of the indentation
/// lambda (m), the striker's displacement minus that of the struck point.
///
/// A user-defined law derives from this class and is assigned to `Case::parts.contact_law`; the
/// built-in laws use the same interface. It must define `force`, the curve of unloading and
/// reloading for a given history; a law that yields or leaves a dent also defines the two ends of
/// that curve. With the largest indentation so far lambda_m (the history), the residual indentation
/// lambda_r and the yield threshold lambda_y,
///
///     separated  lambda <= lambda_r               F = 0
///     elastic    lambda_r < lambda <= lambda_y    F = force(history, lambda)
///     plastic    lambda > lambda_y, growing       F = force({lambda}, lambda)
/// By default slopes are difference quotients of the force, and energies its integrals; a law may
/// give closed forms instead. A law that yields from the first touch has the threshold lambda_m.
///
/// **Requirements.** Steps end at the events at which one branch follows another, and the balances
/// of energy and impulse of the run contain the energies of the law, so a law that breaks one of
/// these rules ends the run as `inaccurate`:
///
///   - the functions are pure: they depend on their arguments alone, change nothing, and may be
///     called from several threads at once;
///   - F is continuous: force is 0 at lambda_r; at lambda_y it is the same for the history before
///     yielding goes on and for the history {lambda_y} after it;
///   - the force is compressive: F > 0 in the elastic and plastic range;
///   - 0 <= lambda_r <= lambda_y, and neither falls while lambda_m grows;
///   - where given, the slopes are the derivatives of the forces;
///   - where given, the energies are the work of the force: d(recoverable)/d lambda = F on the
///     elastic branch; along the plastic branch recoverable + dissipated grow by F d lambda.
///     Dissipated never falls.
///
/// Forces are also evaluated slightly beyond the range of their branch, in steps that are then cut
/// at the end of the branch: there they should continue smoothly, with either sign. One evaluation
/// of the equations of motion evaluates one force.
///
/// The history is changed only by the run, at accepted steps and events, never inside an
/// evaluation. With `contact.damping` the force of any law that does not yield is F (1 + chi
/// lambda'), by the methods that integrate it; other forces that depend on velocities do not fit.
class ContactLaw {
 public:
  virtual ~ContactLaw() = default;

  /// For summaries: "Walton and Braun, k1 = 1e7 N/m".
  virtual std::string name() const = 0;
  /// Force (N) of unloading and reloading, at lambda_r < lambda <= lambda_y.
  virtual double force(ContactHistory history, double indentation) const = 0;
  /// lambda_r, m: where the force ends on unloading and begins on reloading. By default 0.
  virtual double residual_indentation(ContactHistory /*history*/) const { return 0.0; }
  /// lambda_y, m: the indentation above which the contact yields (further). By default infinite.
  virtual double yield_threshold(ContactHistory /*history*/) const {
    return std::numeric_limits<double>::infinity();
  }

  /// By default a power through the forces at 1 and 2 um.
  virtual ContactScales scales() const;
  /// dF/dlambda of `force`, N/m.
  virtual double slope(ContactHistory history, double indentation) const;
  /// N: force({lambda}, lambda); a law may give a form that continues smoothly to small lambda.
  virtual double plastic_force(double indentation) const {
    return force({indentation}, indentation);
  }
  virtual double plastic_slope(double indentation) const;  ///< N/m

  /// Work (J) that the contact returns on unloading from this indentation. On the plastic branch
  /// `history` is {indentation}.
  virtual double recoverable_energy(ContactHistory history, double indentation) const;
  /// Work (J) that plastic indentation has consumed so far.
  virtual double dissipated_energy(ContactHistory history) const;

  /// The largest slope dF/dlambda (N/m) of any history up to an indentation: the step limit of
  /// central differences follows from it. By default the slope of unloading from that indentation.
  virtual double largest_slope(double indentation) const {
    return slope({indentation}, indentation);
  }

  /// The indentation (m) beyond which the law does not hold: a run that reaches it ends there. By
  /// default infinite; no run goes deeper than the beam is thick.
  virtual double largest_indentation() const { return std::numeric_limits<double>::infinity(); }
  /// What ends a law: the contact is too wide, the points end, or columns as high as the beam do.
  enum class Limit { width, last_point, height };
  virtual Limit limit() const { return Limit::width; }

  /// The branch on which `indentation` lies, given the history.
  ContactBranch branch(ContactHistory history, double indentation) const;
  double branch_force(ContactBranch branch, ContactHistory history, double indentation) const;
  double branch_slope(ContactBranch branch, ContactHistory history, double indentation) const;
  /// Force (N) of the branch that holds at this indentation.
  double contact_force(ContactHistory history, double indentation) const {
    return branch_force(branch(history, indentation), history, indentation);
  }
  /// The branch on which a contact with this history begins when it closes.
  ContactBranch first_branch(ContactHistory history) const;

  static ContactHistory commit(ContactHistory history, double indentation) {
    return {indentation > history.max_indentation ? indentation : history.max_indentation};
  }

  /// Work (J) of a first loading up to an indentation.
  double work_up_to(double indentation) const {
    return recoverable_energy({indentation}, indentation) + dissipated_energy({indentation});
  }
  /// The largest indentation (m) that work `energy` (J) can press into the surface.
  double indentation_at(double energy) const;

 protected:
  ContactLaw() = default;
  ContactLaw(const ContactLaw&) = default;
  ContactLaw& operator=(const ContactLaw&) = default;
};

/// Samples a contact law up to an indentation (m) and returns, in one sentence, the first rule of
/// ContactLaw that it breaks; nothing if it keeps all rules. Forces and energies may be off by 1e-3
/// of their largest values: the test finds mistakes, not rounding. simulate(Case) calls it for a
/// user-defined law.
std::optional<std::string> broken_rule(const ContactLaw& law, double largest_indentation);

}  // namespace subimpact
