#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "simulate/loop/observed_step.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// Instant (s) and size (N) of the largest force of a contact (StruckBeam::contact) within a step,
/// damped or not; `so_far`: of steps before, `state`: work space.
std::pair<double, double> largest_force(const ObservedStep& step, const StruckBeam& beam,
                                        std::size_t contact, double so_far, State& state);

/// Records the contacts of a beam with supports that it can lift off.
class SupportRecorder {
 public:
  explicit SupportRecorder(const StruckBeam& beam) : open_(beam.supports().size()) {}

  void on_step(const ObservedStep& step, const StruckBeam& beam, Result& result);
  /// It lifts off.
  void lift(const Transition& event, const StruckBeam& beam, Result& result);
  /// Closes the accounts at the end of the run, drops contacts and transitions that are none, and
  /// adds mirror images. Needs Result::max_force.
  void finish(const StruckBeam& beam, double length, Result& result);

 private:
  struct Open {
    std::size_t contact;  // in the result
    double impulse;       // N s, at its start
  };
  std::vector<std::optional<Open>> open_;  // by support
  State state_;
};

}  // namespace subimpact
