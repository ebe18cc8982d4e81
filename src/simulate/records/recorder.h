#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "simulate/loop/event_loop.h"
#include "simulate/loop/quadratures.h"
#include "simulate/near_miss_search.h"
#include "simulate/records/field_recorder.h"
#include "simulate/records/support_recorder.h"
#include "subimpact/simulate/observer.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

class KeptRows final : public RowSink {
 public:
  explicit KeptRows(Result& result) : result_(result) {}
  void add(const HistoryRow& row) override { result_.history.push_back(row); }
  void add(const SectionRow& row) override { result_.section_history.push_back(row); }
  void add(const PointRow& row) override { result_.point_history.push_back(row); }
  void add(const ShapeRow& row) override { result_.shapes.push_back(row); }

 private:
  Result& result_;
};

/// Records sub-impacts, near misses, transitions and history rows of a run.
class Recorder final : public RunObserver {
 public:
  /// `interval` in s between history rows, 0 for none. `audit` checks rows and impulses before they
  /// are stored. `rows`, if any, takes the rows in place of the result.
  Recorder(const StruckBeam& beam, double interval, EventHandling events, Audit& audit,
           Result& result, RowSink* rows = nullptr);

  /// Keeps the fields along the beam and the bending of single sections that are asked for.
  void keep_fields(const RunParts& parts);

  /// Adds rows during contact wherever the force has changed, as in OutputOptions::interval.
  void follow_force() { follows_force_ = true; }

  /// Shows the run to a user's observer, after it has been recorded.
  void show(Observer& observer) { observer_ = &observer; }

  void on_approach(double end, StruckBeam& beam) override;
  void on_step(const ObservedStep& step, StruckBeam& beam) override;
  /// Checks that the contact force is compressive wherever the indentation is positive.
  void on_accepted(double time, const State& y, StruckBeam& beam) override;
  void on_reversal(const Transition& reversal) override;
  void before_event(const Transition& event, const State& y, StruckBeam& beam) override;
  void after_event(const Transition& event, const State& y, StruckBeam& beam) override;

  /// Each row is audited, and with rows there is one on either side of an event.
  bool audits_events() const override { return row_instants_.exist(); }

  /// Closes the accounts at the last state, which `is_good` if every check passed.
  void finish(double time, const State& y, const StruckBeam& beam, bool is_good);

  const std::vector<long>& steps_in_contact() const { return steps_in_contact_; }

 private:
  // A contact (opening) or a separation (closing) begins, and what was before it ends.
  void begin(NearMissKind kind, const StruckBeam& beam);
  // How far the beam leaves its straight shape, at separations, rows and the end.
  void follow_deformation(const State& y);
  void follow_displacement(double struck_point) {
    result_.largest_displacement = std::max(result_.largest_displacement, std::abs(struck_point));
  }
  void close_sub_impact(double time, const State& y, const StruckBeam& beam);
  void add_row_of_force(const ObservedStep& step, const StruckBeam& beam);
  void add_rows_within(const ObservedStep& step, StruckBeam& beam);
  void add_rows(double time, bool row, bool shape, const State& y, Accounts& accounts);
  void integrate_force(const ObservedStep& step, const StruckBeam& beam);
  void follow_peak(double time, double indentation, const StruckBeam& beam);
  void follow_force(double time, double force);
  void look_for_peak(const ObservedStep& step, StruckBeam& beam);
  // Contact only pushes: a force below zero by no more than the tolerance is none.
  void check_push(double time, double force) const;
  void check_push(double time, const State& y, const StruckBeam& beam);
  void add_event_row(const Transition& event, const State& y);
  // `accounts`: of the histories that hold at y.
  void add_row(double time, const State& y, Accounts& accounts);
  void keep(const HistoryRow& row, const State& y, Accounts& accounts);
  Result::Velocities velocities(double time, const State& y) const;
  HistoryRow make_row(double time, const State& y, Accounts& accounts);
  void add_section_rows(double time, const State& y, Accounts& accounts);

  Result& result_;
  KeptRows kept_rows_;
  RowSink& rows_;
  Observer* observer_ = nullptr;
  Instants row_instants_;
  EventHandling events_;
  Audit& audit_;
  Accounts accounts_;
  FirstFlow first_flow_;
  ForceQuadrature force_;
  LossQuadrature losses_;  // within a step
  SupportRecorder supports_;
  NearMissSearch near_misses_;
  LargestGap largest_gap_;
  double striker_mass_;
  std::vector<double> row_times_;  // of a flight, s
  bool follows_force_ = false;
  HistoryRow last_row_{};
  bool in_contact_ = false;
  double velocity_at_start_ = 0.0;
  double beam_impulse_at_start_ = 0.0;
  State state_;
  SectionCorrection correction_;             // of a state within a step
  std::vector<std::size_t> sections_;        // whose bending is kept
  double half_height_ = 0.0, length_ = 0.0;  // m, of section and beam
  std::unique_ptr<FieldRecorder> fields_;    // none: no field is kept
  std::vector<SparseFunctional> rotations_;
  std::vector<double> rigid_motion_;  // at the struck point; empty: none
  std::vector<long> steps_in_contact_;
};

}  // namespace subimpact
