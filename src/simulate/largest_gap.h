#pragma once

#include "simulate/loop/observed_step.h"

namespace subimpact {

/// Finds the largest gap (m) between striker and beam in a separation, step by step: at the ends of
/// steps, and where within a step its rate vanishes (docs/theory.md, "Events").
class LargestGap {
 public:
  /// `of_trajectory`: whether states within a step follow the trajectory better than the cubic
  /// through the ends of the step does.
  explicit LargestGap(bool of_trajectory) : of_trajectory_(of_trajectory) {}

  /// A step of the separation. `largest`: that of the steps before it, and then with it.
  void follow(const ObservedStep& step, const StruckBeam& beam, double& largest);

 private:
  void look_into(const ObservedStep& step, const StruckBeam& beam, IndentationStep part,
                 double& largest);
  void look_into_flight(const ObservedStep& step, const StruckBeam& beam, double& largest);

  bool of_trajectory_;
  State state_;  // within a step
};

}  // namespace subimpact
