#pragma once

#include <optional>
#include <vector>

#include "ode/integrator.h"
#include "subimpact/simulate/options.h"
#include "system/contact/contact_events.h"
#include "system/section/section_correction.h"

namespace subimpact {

/// Bound of the rounding of an event function that vanishes at t (s): m, or m/s for one of the
/// rate.
double rounding_of(const EventFunction& function, const StruckBeam& beam, const State& y, double t,
                   const EventValue& at);

/// Where a step, or its shortened part, ends.
struct FoundEnd {
  double t;        ///< s
  const State* y;  ///< without the section correction
  std::optional<EventFunction> event = {};
};

/// Finds the end of a step: its first event of any contact (docs/theory.md, "Events"), or where its
/// section correction stops being valid, or its own end. If sections leave their smooth pieces
/// before the event, it is located again on the corrected trajectory. A root at which the
/// integrator has ended the step counts unless it lies behind the end of the section correction.
class EventLocator {
 public:
  EventLocator(StruckBeam& beam, Integrator& integrator, SectionCorrector& corrector,
               EventHandling events, bool double_roots)
      : beam_(beam),
        integrator_(integrator),
        corrector_(corrector),
        events_(events),
        double_roots_(double_roots) {}

  /// The first event of a step or, if there is none, its end. The state is stored in this object
  /// until the next call, unless it is that of the whole step. `indentation`: of the whole step.
  FoundEnd find_end(const StepEnds& whole, const IndentationStep& indentation);
  /// The section correction of the step to the end found last, not yet added to its state.
  const SectionCorrection& correction() const { return correction_; }

 private:
  // The earliest event before an end of the step, or else that end. `ends`: of the whole step.
  FoundEnd find_event(const StepEnds& whole, IndentationStep ends, FoundEnd end);
  // The same, of a step that the integrator's own root-finding has shortened.
  FoundEnd event_of_integrator(const StepEnds& whole, FoundEnd end);
  // The event of a step to `end` that appears only when the correction is added. `ends`: of the
  // whole step.
  std::optional<EventFunction> event_of_correction(IndentationStep ends, const State& y0,
                                                   const FoundEnd& end);
  // `ends`: of the striker's contact.
  std::optional<Crossing> find_crossing_in(const IndentationStep& ends, const State& y0,
                                           const State& y1);
  // Whether the double root of a crossing exists; if so, narrows it to the first of the two.
  bool resolve(Crossing& crossing, const StepEnds& step);
  // The instant of a crossing (s), its state in trial_.
  double locate(const Crossing& crossing, const StepEnds& step);
  // The instant (s), its state in end_, at which the corrected state meets an event function whose
  // root was found at step.t1; nothing if that is not before `latest`.
  std::optional<double> relocate(const EventFunction& function, const StepEnds& step,
                                 double latest);

  StruckBeam& beam_;
  Integrator& integrator_;
  SectionCorrector& corrector_;
  EventHandling events_;
  bool double_roots_;
  std::vector<EventFunction> dealt_with_;  // in the step being searched
  State end_, trial_;
  SectionCorrection correction_;
};

}  // namespace subimpact
