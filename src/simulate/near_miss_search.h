#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "simulate/loop/observed_step.h"
#include "subimpact/simulate/records.h"

namespace subimpact {

/// Whether the indentation, times `sense`, may fall and rise again between the ends of a step.
inline bool may_turn(const IndentationStep& ends, double sense) {
  const bool falls = sense * ends.rate0 < 0.0;
  const bool rises_then = sense * ends.rate1 >= 0.0;
  if (falls == rises_then) return falls;
  return ends.length() * std::abs(ends.rate0 + ends.rate1) >
         3.0 * std::abs(ends.lambda1 - ends.lambda0);
}

/// The part of a step between two times, read off the trajectory; nothing if there are none.
std::optional<IndentationStep> part_around(const ObservedStep& step, const StruckBeam& beam,
                                           const std::optional<std::pair<double, double>>& times,
                                           State& state);

/// Finds the near misses of one contact or separation after the other, step by step
/// (docs/theory.md, "Events"). Of each the nearest few are kept.
class NearMissSearch {
 public:
  /// A contact (`opening`) or a separation (`closing`) begins.
  void begin(NearMissKind kind) {
    kind_ = kind;
    sense_ = kind == NearMissKind::opening ? 1.0 : -1.0;
    farthest_ = -std::numeric_limits<double>::infinity();
    kept_.clear();
  }

  /// A step of it. `refine`: whether states within the step follow the trajectory better than the
  /// cubic does.
  void follow(const ObservedStep& step, const StruckBeam& beam, bool refine) {
    const IndentationStep& ends = step.indentation();
    farthest_ = std::max(farthest_, sense_ * ends.lambda1);
    if (step.ends().event_free) {
      const auto times = step.integrator().around_largest();
      if (const auto part = part_around(step, beam, times, state_)) {
        look_into(step, beam, *part, true);
      }
    } else if (may_turn(ends, sense_)) {
      look_into(step, beam, ends, refine);
    }
  }

  /// Of a separation that lasts until the end of the run: none if the gap only grows.
  std::optional<ClosestApproach> closest(double end, const State& y, const StruckBeam& beam) const;

  /// Appends the near misses of the contact or separation that ends, in order of time: those whose
  /// margin is below half of the largest gap reached. `residual`: lambda_r at its end, m.
  void finish(double residual, std::vector<NearMiss>& near_misses);

 private:
  static constexpr std::size_t most_kept = 8;

  void look_into(const ObservedStep& step, const StruckBeam& beam, const IndentationStep& ends,
                 bool refine);
  void keep(const NearMiss& near_miss);

  NearMissKind kind_ = NearMissKind::closing;
  double sense_ = -1.0;                                         // of the indentation when g grows
  double farthest_ = -std::numeric_limits<double>::infinity();  // sense * lambda, m
  std::vector<NearMiss> kept_;  // of the present contact or separation, the nearest first
  State state_;                 // within a step
};

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

  bool of_trajectory_;
  State state_;  // within a step
};

}  // namespace subimpact
