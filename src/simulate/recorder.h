#pragma once

#include <memory>
#include <optional>

#include "simulate/event_loop.h"
#include "simulate/field_recorder.h"
#include "simulate/force_quadrature.h"
#include "simulate/near_miss_search.h"
#include "subimpact/simulate/result.h"
#include "system/deformation.h"

namespace subimpact {

/// Records sub-impacts, near misses, transitions and history rows of a run.
class Recorder final : public RunObserver {
 public:
  /// `interval` in s between history rows, 0 for none. `audit` checks rows and impulses before they
  /// are stored.
  Recorder(const StruckBeam& beam, double interval, EventHandling events, Audit& audit,
           Result& result);

  /// Keeps the bending of these sections (indices) too, at every history row.
  void keep_sections(std::vector<std::size_t> sections) { sections_ = std::move(sections); }

  /// Keeps the fields along the beam, as far as they are asked for.
  void keep_fields(const FieldOptions& options);

  /// Rows go to `rows` in place of the result.
  void send_rows_to(RowSink& rows);

  void on_approach(double end, StruckBeam& beam) override;
  void on_step(const ObservedStep& step, StruckBeam& beam) override;
  /// Checks that the contact force is compressive wherever the indentation is positive.
  void on_accepted(double time, const State& y, StruckBeam& beam) override;
  void on_reversal(const Transition& reversal) override { result_.transitions.push_back(reversal); }
  void before_event(const Transition& event, const State& y, StruckBeam& beam) override;
  void after_event(const Transition& event, const State& y, StruckBeam& beam) override;

  /// Each row is audited, and with rows there is one on either side of an event.
  bool audits_events() const override { return interval_ > 0.0; }

  /// Closes the accounts at the last state, which `is_good` if every check passed.
  void finish(double time, const State& y, const StruckBeam& beam, bool is_good);

  /// Steps within each contact.
  const std::vector<long>& steps_in_contact() const { return steps_in_contact_; }

 private:
  // A contact (opening) or a separation (closing) begins, and what was before it ends.
  void begin(NearMissKind kind, const StruckBeam& beam);
  void close_sub_impact(const State& y, const StruckBeam& beam);
  void add_rows_within(const ObservedStep& step, StruckBeam& beam);
  // A history row, a shape, or both.
  void add_rows(double time, bool row, bool shape, const State& y, Accounts& accounts);
  void integrate_force(const ObservedStep& step, const StruckBeam& beam);
  void follow_peak(double indentation, const StruckBeam& beam);
  // The peak of a damped force, which comes before that of the indentation.
  void follow_damped_force(const ObservedStep& step, const StruckBeam& beam);
  // The state within the step, in state_, with what is lost up to there.
  void add_damped_rows(double time, bool row, bool shape, const ObservedStep& step,
                       StruckBeam& beam);
  void look_for_peak(const ObservedStep& step, StruckBeam& beam);
  // Contact only pushes: a force below zero by no more than the tolerance is none.
  void check_push(HistoryRow& row) const;
  void check_push(double time, double force) const;
  void add_event_row(const Transition& event, const State& y);
  // `accounts`: of the histories that hold at y.
  void add_row(double time, const State& y, Accounts& accounts);
  void keep(const HistoryRow& row, const State& y, Accounts& accounts);
  HistoryRow make_row(double time, const State& y, Accounts& accounts);
  void add_section_rows(double time, const State& y, Accounts& accounts);

  Result& result_;
  RowSink* rows_ = nullptr;  // none: the result keeps the rows
  double interval_;
  EventHandling events_;
  Audit& audit_;
  Accounts accounts_;
  FirstFlow first_flow_;
  ForceQuadrature force_;
  LossQuadrature losses_;  // within a step
  NearMissSearch near_misses_;
  double striker_mass_;
  long next_row_ = 0;
  double last_row_time_ = -1.0;  // s
  bool in_contact_ = false;
  double velocity_at_start_ = 0.0;
  double largest_force_ = 0.0;  // of all contacts so far, N
  State state_;
  SectionCorrection correction_;  // of a state within a step
  std::vector<std::size_t> sections_;
  std::unique_ptr<FieldRecorder> fields_;   // none: no field is kept
  std::optional<Deformation> deformation_;  // seen at separations, at rows and at the end
  std::vector<long> steps_in_contact_;
};

}  // namespace subimpact
