#pragma once

#include <optional>
#include <vector>

#include "ode/integrator.h"
#include "system/struck_beam.h"

namespace subimpact {

/// The indentation (m) of a contact and its rate (m/s) at both ends of a step or a part of one.
struct IndentationStep {
  double t0, t1;  ///< s
  double lambda0, rate0, lambda1, rate1;
  double length() const { return t1 - t0; }
};
IndentationStep indentation_step(const StruckBeam& beam, std::size_t contact, double t0, double t1,
                                 std::span<const double> y0, std::span<const double> y1);

/// An event of a contact within a step: a bracket of its time (s).
struct Crossing {
  EventFunction function;
  double t_lower = 0.0;  ///< the event function is not positive here
  double t_upper = 0.0;  ///< it is positive here
  double guess = 0.0;    ///< estimate of the instant
  /// The event function is negative at both ends of the step and comes close to zero in between,
  /// near `guess`: whether it has a double root is decided on the trajectory.
  bool unresolved = false;
};

struct CrossingSearch {
  /// Event functions that are left out, because their events in this step have been treated.
  const std::vector<EventFunction>& without;
  /// Whether a branch left and regained within one step is looked for; off only for studies.
  bool double_roots = true;
  /// m: an excursion smaller than this is below the rounding of the displacements.
  double rounding = 0.0;
  std::size_t contact = 0;   ///< whose
  double dead_length = 0.0;  ///< StruckBeam::dead_length(), m
};

/// The earliest end of the branch in force within a step that began at the last committed state, by
/// the cubic through the ends of the step; nothing if the branch holds throughout.
std::optional<Crossing> find_crossing(const ContactState& contact, const IndentationStep& step,
                                      const CrossingSearch& search);

struct InterpolatedEvent {
  EventFunction function;
  double time;  ///< s
};

/// Adds the events of a step of a contact that ends on another branch, `after`, than that in force.
void interpolate_events(const ContactState& contact, std::size_t number,
                        const IndentationStep& step, ContactBranch after,
                        std::vector<InterpolatedEvent>& events);

/// The event functions of the branches in force of all contacts, for integrators with
/// root-finding of their own: indentations over the scene's displacement, rates over its velocity.
///
/// A contact begins, yields or ends where its function exceeds the rounding of displacements, or
/// the dead length of a support: just after an event functions are zero, and their rounding is not
/// an event.
class ContactEventFunctions final : public EventFunctions {
 public:
  /// `beam` must outlive this. `double_roots`: whether a branch left and regained within one step
  /// is found, by the rates.
  ContactEventFunctions(const StruckBeam& beam, bool double_roots)
      : beam_(beam), double_roots_(double_roots) {}

  std::size_t size() const override;
  void evaluate(std::span<const double> y, std::span<EventValue> values) const override;
  /// One of them, by its number in these.
  static EventFunction function_of(const StruckBeam& beam, std::size_t number);

 private:
  const StruckBeam& beam_;
  bool double_roots_;
};

}  // namespace subimpact
