#pragma once

#include <memory>
#include <span>
#include <utility>

#include "numerics/trajectory_root.h"
#include "subimpact/model/contact_law.h"
#include "subimpact/system/events.h"

namespace subimpact {

/// Evaluation of laws with branches between two commits.
enum class Evaluation {
  smooth,    ///< the branch in force is continued beyond its range; its end is located as an event
  switching  ///< the branch follows the motion, as in schemes that do not locate events
};

/// A condition under which the equations of motion change: a function of the state that is negative
/// before and positive after its event.
struct EventFunction {
  EventKind kind;
  double sense = 1.0;  ///< sign of the indentation rate before contact_unloads
};

/// The events that end a branch.
std::span<const EventKind> event_kinds(ContactBranch branch);

/// The contact between striker and beam in one run: the law, the branch in force and the history.
/// Force and event functions depend on the indentation lambda (m) and its rate (m/s) alone.
///
/// Event functions, by branch (lambda_r, lambda_y: residual indentation, yield threshold):
///
///     separated   contact_begins    lambda - lambda_r
///     elastic     contact_ends      lambda_r - lambda
///                 contact_yields    lambda - lambda_y
///     plastic     contact_unloads   -lambda'
class ContactState {
 public:
  explicit ContactState(std::shared_ptr<const ContactLaw> law) : law_(std::move(law)) {}

  const ContactLaw& law() const { return *law_; }
  ContactBranch branch() const { return branch_; }
  ContactHistory history() const { return history_; }
  bool is_closed() const { return branch_ != ContactBranch::separated; }
  double residual_indentation() const { return law_->residual_indentation(history_); }

  double force(double indentation) const;  ///< F, N
  double slope(double indentation) const;  ///< dF/dlambda, N/m

  struct Energies {
    double elastic, plastic;  ///< J
  };
  Energies energies(double indentation) const;

  /// Value (m) and rate (m/s) of an event function; for contact_unloads the value is -rate, and the
  /// rate of that value, which needs the acceleration, is left at 0.
  EventValue event_function(EventKind kind, double indentation, double rate) const;

  /// Whether the largest indentation grows with the present one.
  bool loads() const {
    return branch_ == ContactBranch::plastic || evaluation_ == Evaluation::switching;
  }
  void set_evaluation(Evaluation how) { evaluation_ = how; }
  /// Sets a branch and a history, as at the start of a run.
  void set(ContactBranch branch, ContactHistory history) {
    branch_ = branch;
    history_ = history;
  }
  /// Advances the history to this indentation.
  void commit(double indentation);
  /// Changes the branch at an event of the contact.
  void pass(EventKind event, double indentation);
  /// For schemes that do not locate events: the branch on which the indentation lies.
  void follow(double indentation) { branch_ = law_->branch(history_, indentation); }

 private:
  std::shared_ptr<const ContactLaw> law_;
  Evaluation evaluation_ = Evaluation::smooth;
  ContactBranch branch_ = ContactBranch::separated;
  ContactHistory history_;
};

}  // namespace subimpact
