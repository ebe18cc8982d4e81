#pragma once

#include <cstddef>

#include "simulate/run_parts.h"
#include "subimpact/case/simulate.h"
#include "subimpact/model/beam_mesh.h"

namespace subimpact {

/// The elastic beam of a case in free vibration, contact open, under one of the one-step methods
/// with a fixed step. Nothing is located and nothing yields: what is left is the method itself.
class FreeVibration {
 public:
  /// Method and table are those of the case. Throws InvalidCase.
  explicit FreeVibration(const Case& input);

  std::size_t n_modes() const { return modes_.size(); }
  double frequency(std::size_t mode) const { return modes_.frequencies[mode]; }  ///< rad/s
  /// The mesh's bound of the highest frequency, from which limits are predicted, rad/s.
  double highest_frequency() const;

  /// By how much `n_steps` steps multiply the amplitude of a natural mode, per step: the largest
  /// eigenvalue of what they do to (omega times the mode's displacement, its velocity), found from
  /// two runs. Infinite where the numbers overflow.
  double growth(std::size_t mode, double step, int n_steps);

 private:
  // The mode's displacement times omega, and its velocity, after the steps.
  struct Amplitudes {
    double displacement, velocity;
  };
  Amplitudes run(std::size_t mode, double step, int n_steps, const Amplitudes& start);

  ResolvedRun run_;
  StruckBeam& beam_;
  NaturalModes modes_;
};

}  // namespace subimpact
