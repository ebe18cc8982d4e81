#pragma once

#include "simulate/event_loop.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// Makes sub-impacts, transitions and history rows out of a run.
class Recorder final : public RunObserver {
 public:
  /// `interval` in s between history rows, 0 for none.
  Recorder(StruckBeam& beam, const State& initial, double interval, EventHandling events,
           Result& result);

  /// Keeps the bending of these sections (indices) too, at every history row.
  void keep_sections(std::vector<std::size_t> sections) { sections_ = std::move(sections); }

  void on_step(const StepEnds& step, StruckBeam& beam, Integrator& integrator) override;
  void on_turn(const Transition& turn) override { result_.transitions.push_back(turn); }
  void before_event(const Transition& event, const State& y, StruckBeam& beam) override;
  void after_event(const Transition& event, const State& y, StruckBeam& beam) override;

  /// Closes the accounts at the last state.
  void finish(double time, const State& y, StruckBeam& beam);

 private:
  void follow_peak(double indentation, double force);
  void look_for_peak(const StepEnds& step, StruckBeam& beam, Integrator& integrator);
  void add_row(double time, const State& y, StruckBeam& beam);
  HistoryRow make_row(double time, const State& y, StruckBeam& beam) const;
  void keep_errors(const HistoryRow& row);
  void add_section_rows(double time, const State& y, StruckBeam& beam);

  Result& result_;
  double interval_;
  EventHandling events_;
  double striker_mass_;
  double initial_energy_;
  double initial_momentum_;
  long next_row_ = 0;
  bool in_contact_ = false;
  double velocity_at_start_ = 0.0;
  State state_;
  std::vector<std::size_t> sections_;
};

}  // namespace subimpact
