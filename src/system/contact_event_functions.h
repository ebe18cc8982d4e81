#pragma once

#include "ode/integrator.h"
#include "system/struck_beam.h"

namespace subimpact {

/// The event functions of the contact's branch in force (event_kinds), for integrators with
/// root-finding of their own: indentations over the scene's displacement, rates over its velocity.
///
/// A contact begins, yields or ends where its function exceeds the rounding of displacements: just
/// after an event functions are zero, and their rounding is not an event.
class ContactEventFunctions final : public EventFunctions {
 public:
  /// `beam` must outlive this. `double_roots`: whether a branch left and regained within one step
  /// is found, by the rates.
  ContactEventFunctions(const StruckBeam& beam, bool double_roots)
      : beam_(beam), double_roots_(double_roots) {}

  std::size_t size() const override { return event_kinds(beam_.contact().branch()).size(); }
  void evaluate(std::span<const double> y, std::span<EventValue> values) const override;

 private:
  const StruckBeam& beam_;
  bool double_roots_;
};

}  // namespace subimpact
