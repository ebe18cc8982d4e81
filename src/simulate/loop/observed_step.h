#pragma once

#include "ode/integrator.h"
#include "system/contact/contact_events.h"
#include "system/section/section_correction.h"

namespace subimpact {

/// A step, or a part of one between two interpolated events, as observers see it: before the
/// correction of its end and before it is committed. The equations are still those of the step, so
/// states within the step can be computed.
class ObservedStep {
 public:
  /// `indentation`: at the ends. `from_end`: whether states within the step are its end followed
  /// backwards (Integrator::state_before_end). All must outlive this.
  ObservedStep(const StepEnds& ends, const IndentationStep& indentation, Integrator& integrator,
               SectionCorrector& corrector, bool from_end = false)
      : ends_(ends),
        indentation_(indentation),
        integrator_(integrator),
        corrector_(corrector),
        from_end_(from_end) {}

  double t0() const { return ends_.t0; }  ///< s
  double t1() const { return ends_.t1; }  ///< s
  double length() const { return ends_.length(); }
  const State& y0() const { return ends_.y0; }
  const State& y1() const { return ends_.y1; }
  const StepEnds& ends() const { return ends_; }
  const IndentationStep& indentation() const { return indentation_; }

  /// The method's state at a time (s) within the step, without the section correction.
  void state_at(double t, State& y) const {
    if (from_end_) {
      integrator_.state_before_end(t, y);
    } else {
      integrator_.state_at(t, y);
    }
  }
  /// For what else it knows of its last step.
  Integrator& integrator() const { return integrator_; }
  /// The state at a time within the step as if the step ended there, section events included.
  void corrected_state_at(double t, State& y, SectionCorrection& correction) const {
    state_at(t, y);
    corrector_.correct({ends_.t0, t, ends_.y0, y, ends_.event_free}, correction);
    correction.add_to(y);
  }

 private:
  const StepEnds& ends_;
  const IndentationStep& indentation_;
  Integrator& integrator_;
  SectionCorrector& corrector_;
  bool from_end_;
};

}  // namespace subimpact
