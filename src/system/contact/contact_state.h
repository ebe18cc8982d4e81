#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "numerics/bracketed_root.h"
#include "subimpact/model/contact/contact_law.h"
#include "subimpact/model/mesh/beam_mesh.h"
#include "subimpact/model/scene.h"
#include "subimpact/system/readings.h"

namespace subimpact {

/// Evaluation of laws with branches between two commits.
enum class Evaluation {
  smooth,    ///< the branch in force is continued beyond its range; its end is located as an event
  switching  ///< the branch follows the motion, as in schemes that do not locate events
};

/// What an event function is a function of.
enum class EventVariable {
  indentation,
  rate  ///< contact_unloads; a damped contact that begins or ends as its rate passes -1/chi
};

/// A condition under which the equations of motion change: a function of the state that is negative
/// before and positive after its event.
struct EventFunction {
  EventKind kind;
  EventVariable variable;
  std::size_t contact = 0;  ///< whose: of the striker (0) or of a support that lifts

  constexpr EventFunction(EventKind kind)
      : EventFunction(kind, kind == EventKind::contact_unloads ? EventVariable::rate
                                                               : EventVariable::indentation) {}
  constexpr EventFunction(EventKind kind, EventVariable variable)
      : kind(kind), variable(variable) {}
  bool of_rate() const { return variable == EventVariable::rate; }
  bool operator==(const EventFunction&) const = default;
};

/// The contact between striker and beam in one run: the law, the branch in force and the history.
/// Force and event functions depend on the indentation lambda (m) and its rate (m/s) alone
/// (docs/theory.md, "Events"; of a damped contact, for laws that never yield: "Contact").
class ContactState {
 public:
  /// `damping`: chi, s/m, of touches at `restitution_velocity` (m/s) or, where that is 0, of all.
  explicit ContactState(std::shared_ptr<const ContactLaw> law, double damping = 0.0,
                        double restitution_velocity = 0.0)
      : law_(std::move(law)),
        damping_(damping),
        damping_number_(damping * restitution_velocity),
        slowest_touch_(slowest_damped_touch * restitution_velocity) {}

  bool is_damped() const { return damping_ > 0.0; }
  /// Whether the striker has left a surface that is still indented, in damped contacts.
  bool is_recovering() const { return recovering_; }
  std::span<const EventFunction> event_functions() const;

  const ContactLaw& law() const { return *law_; }
  ContactBranch branch() const { return branch_; }
  ContactHistory history() const { return history_; }
  bool is_closed() const { return branch_ != ContactBranch::separated; }
  /// Whether force() may differ from zero.
  bool exerts_force() const { return is_closed() || evaluation_ == Evaluation::switching; }
  double residual_indentation() const { return law_->residual_indentation(history_); }

  double force(double indentation) const;                ///< F_0, N: F without damping
  double slope(double indentation) const;                ///< dF_0/dlambda, N/m
  double force(double indentation, double rate) const {  ///< F, N
    return is_damped() ? (1.0 + damping_ * rate) * force(indentation) : force(indentation);
  }
  double slope(double indentation, double rate) const {  ///< dF/dlambda, N/m
    return is_damped() ? (1.0 + damping_ * rate) * slope(indentation) : slope(indentation);
  }
  /// dF/dlambda', N s/m.
  double rate_slope(double indentation) const { return damping_ * force(indentation); }
  /// Dissipated by damping while the contact is closed, W.
  double damping_power(double indentation, double rate) const {
    return damping_ * rate * rate * force(indentation);
  }

  struct Energies {
    double elastic, plastic;  ///< J
  };
  Energies energies(double indentation) const;

  /// Value (m) and rate (m/s) of an event function. The rate of a value that is a rate of the
  /// indentation (m/s) needs the acceleration and is left at 0.
  EventValue event_function(const EventFunction& function, double indentation, double rate) const;

  /// Whether the largest indentation grows with the present one.
  bool loads() const {
    return branch_ == ContactBranch::plastic || evaluation_ == Evaluation::switching;
  }
  void set_evaluation(Evaluation how) { evaluation_ = how; }
  void set(ContactBranch branch, ContactHistory history) {
    branch_ = branch;
    history_ = history;
  }
  void commit(double indentation) {
    if (loads()) history_ = ContactLaw::commit(history_, indentation);
  }
  void pass(const EventFunction& event, double indentation);
  /// A contact begins at a rate (m/s). Hunt and Crossley's coefficient of restitution depends on
  /// chi times that rate alone, and stays what it is from a hundredth of restitution_velocity on: a
  /// slower touch, a graze, has the chi of that, so that it is no wall.
  void touch(double rate) {
    if (damping_number_ > 0.0) damping_ = damping_number_ / std::max(rate, slowest_touch_);
  }
  /// For schemes that do not locate events: the branch on which the indentation lies.
  void follow(double indentation) { branch_ = law_->branch(history_, indentation); }

 private:
  static constexpr double slowest_damped_touch = 0.01;
  ContactBranch branch_at(double indentation) const {
    return evaluation_ == Evaluation::switching ? law_->branch(history_, indentation) : branch_;
  }

  std::shared_ptr<const ContactLaw> law_;
  double damping_;
  double damping_number_, slowest_touch_;
  bool recovering_ = false;
  Evaluation evaluation_ = Evaluation::smooth;
  ContactBranch branch_ = ContactBranch::separated;
  ContactHistory history_;
};

/// A spring that only pushes (Spring::one_sided) as a contact of its own, between one point of the
/// beam and the ground: its indentation is d = a.w - gap, with the displacement a.w of that point
/// towards it; the force on the beam is -F(d, d') a.
struct LiftingSupport {
  std::size_t spring;         ///< its number in Beam::springs, from 0
  double position;            ///< x, m
  double sense;               ///< 1: behind the beam; -1: before it
  double gap;                 ///< m
  double copies;              ///< 2 where its mirror image is folded in
  SparseFunctional approach;  ///< a
  ContactState contact;
  /// m: it touches or lifts only where the indentation passes zero by more, so that rounding is no
  /// event, be it that of a beam that touches without force.
  double dead_length;
  double impulse = 0.0;  ///< N s, of its force since the start

  double indentation(std::span<const double> unknowns) const { return approach(unknowns) - gap; }
  double stiffness() const { return contact.law().scales().stiffness; }
  std::size_t half_bandwidth() const;  ///< of a a^T
};

/// Those of a beam on a mesh, of half a beam those of one half. `length_scale` (m): of the strike.
/// Throws std::invalid_argument for a mesh without displacements at their points.
std::vector<LiftingSupport> lifting_supports(const BeamMesh& mesh, const Beam& beam,
                                             double length_scale);

}  // namespace subimpact
