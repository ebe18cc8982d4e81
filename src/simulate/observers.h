#pragma once

#include "simulate/event_loop.h"
#include "subimpact/simulate/observer.h"

namespace subimpact {

/// The program's own recorder with a user's observer behind it.
class Observers final : public RunObserver {
 public:
  /// Both must outlive this.
  Observers(RunObserver& recorder, Observer& guest) : recorder_(recorder), guest_(guest) {}

  void on_step(const ObservedStep& step, StruckBeam& beam) override;
  void on_accepted(double time, const State& y, StruckBeam& beam) override;
  void on_reversal(const Transition& reversal) override;
  void before_event(const Transition& event, const State& y, StruckBeam& beam) override;
  void after_event(const Transition& event, const State& y, StruckBeam& beam) override;
  bool audits_events() const override { return recorder_.audits_events(); }

 private:
  RunObserver& recorder_;
  Observer& guest_;
};

}  // namespace subimpact
