#pragma once

#include <optional>
#include <vector>

#include "ode/integrator.h"
#include "subimpact/simulate/options.h"
#include "system/contact_events.h"
#include "system/section_correction.h"

namespace subimpact {

/// Bound of the rounding of an event function (m; of contact_unloads m/s) that vanishes at t (s).
double rounding_of(const EventFunction& function, const StruckBeam& beam, const State& y, double t,
                   const EventValue& at);

/// Finds the end of a step: its first event of the contact (docs/theory.md, "Events"), or where its
/// section correction stops being valid, or its own end. If sections leave their smooth pieces
/// before the event, it is located again on the corrected trajectory.
///
/// With EventHandling::library the event is the root at which the integrator has ended the step
/// (Integrator::root); one behind the end of the section correction is left to later steps.
class EventLocator {
 public:
  EventLocator(StruckBeam& beam, Integrator& integrator, SectionCorrector& corrector,
               EventHandling events, bool double_roots)
      : beam_(beam),
        integrator_(integrator),
        corrector_(corrector),
        events_(events),
        double_roots_(double_roots) {}

  /// Shortens the step that begins at (t0, y0) and ends at `t1`, `y1`, by moving the pointer to a
  /// state stored in this object until the next call. Returns the event at the end, if there is
  /// one. `indentation`: of the whole step. `correction`: of the step as it then is, not yet added.
  std::optional<EventFunction> find_end(const StepEnds& whole, const IndentationStep& indentation,
                                        double& t1, const State*& y1,
                                        SectionCorrection& correction);

 private:
  // The earliest event in a step, which is shortened to end there. `ends`: of the whole step.
  std::optional<EventFunction> find_event(const StepEnds& whole, IndentationStep ends, double& t1,
                                          const State*& y1);
  // The same, of a step that the integrator's own root-finding has shortened.
  std::optional<EventFunction> event_of_integrator(const StepEnds& whole, const State*& y1);
  // An event of a step to (t1, y1) that has none before its correction is added, by which the end
  // passes the event function. `ends`: of the whole step.
  std::optional<EventFunction> event_of_correction(IndentationStep ends, double t1, const State& y1,
                                                   const SectionCorrection& correction);
  std::optional<Crossing> find_crossing_in(const IndentationStep& ends, const State& y1);
  // Whether the double root of a crossing exists; if so, narrows it to the first of the two.
  bool resolve(Crossing& crossing, const StepEnds& step);
  // The instant of a crossing, its state in trial_.
  double locate(const Crossing& crossing, const StepEnds& step);
  // Moves an event found at step.t1, with step.y1 in end_, to where the corrected state meets its
  // event function; false if that is not before `latest`: then the step has no event.
  bool relocate(const EventFunction& function, const StepEnds& step, double latest, double& time,
                SectionCorrection& correction);

  StruckBeam& beam_;
  Integrator& integrator_;
  SectionCorrector& corrector_;
  EventHandling events_;
  bool double_roots_;
  std::vector<EventFunction> dealt_with_;  // in the step being searched
  State end_, trial_;
};

}  // namespace subimpact
