#pragma once

namespace subimpact {

/// What becomes of an event inside a step.
enum class EventHandling {
  located,      ///< the step is retaken to end at the event, found on the trajectory itself
  interpolated  ///< the step stands; the event's time is interpolated within it (the paper's
                ///< scheme)
};

enum class ReversalHandling {
  located,  ///< where sections begin to flow or turn is found, and the step's end corrected
  step_end  ///< history advances at step ends only
};

}  // namespace subimpact
