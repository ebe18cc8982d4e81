#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "subimpact/simulate/result.h"
#include "system/readings/beam_field.h"
#include "system/readings/support_reactions.h"

namespace subimpact {

struct RunParts;

/// Instants nearer than this, relative to the time, are one.
inline constexpr double same_instant = 1e-12;

/// The multiples of an interval (s), of which some have been passed; none if it is 0.
class Instants {
 public:
  explicit Instants(double interval) : interval_(interval) {}

  bool exist() const { return interval_ > 0.0; }
  /// Infinite if there are none.
  double next() const {
    return exist() ? static_cast<double>(passed_) * interval_
                   : std::numeric_limits<double>::infinity();
  }
  /// Passes the next one if it is at `time` (s) or before; false if it is later.
  bool reach(double time) {
    if (time < next() * (1.0 - same_instant)) return false;
    ++passed_;
    return true;
  }
  /// Adds those from the next one on, below `end`.
  void add_below(double end, std::vector<double>& times) const {
    for (Instants i = *this; i.next() < end; ++i.passed_) times.push_back(i.next());
  }

 private:
  double interval_;
  long passed_ = 0;
};

/// Records shapes, envelope, permanent set, plastic zones, support reactions, the motion of points
/// and the strains of gauges. Shapes are of regular instants and of the events of the contact. The
/// envelope follows the history rows, some 4000 of them at most, and all shapes.
class FieldRecorder {
 public:
  /// `rows` takes the rows. All must outlive this.
  FieldRecorder(const RunParts& parts, Result& result, RowSink& rows);

  bool is_needed() const {
    return has_shapes() || !points_.empty() || !gauges_.empty() || reactions_;
  }

  /// The next regular instant (s) of the extremes along the beam; infinite: none.
  double next_instant() const;
  /// Adds the regular instants from there on, below `end` (s).
  void add_instants(double end, std::vector<double>& times) const {
    if (has_shapes()) regular_.add_below(end, times);
  }
  /// Takes the extremes of that instant and, where it is due, the shape. `accounts`: of the
  /// histories that hold at y.
  void take_instant(double time, const State& y, Accounts& accounts);
  /// Keeps the shape of a state, once per instant, if its numbers are finite.
  void add_shape(double time, const State& y, Accounts& accounts);
  /// At every history row: the motion of the points, and the envelope.
  void follow(double time, const State& y, Accounts& accounts);
  /// Reactions and strains of gauges.
  void add_readings(HistoryRow& row, const State& y, Accounts& accounts);
  /// At the end: the envelope and, if the state `is_good`, the last shape and the permanent
  /// bending.
  void finish(double time, const State& y, Accounts& accounts, bool is_good);

 private:
  bool has_shapes() const { return field_.size() > 0 && shapes_.exist(); }
  struct Instant {
    double time;
    bool regular;  // whether runs beside one another share it, as they do events
    bool shape;    // whether a shape is due
  };
  // The forces of the supports, whose extremes are followed.
  SupportReactions::Forces reactions(const Instant& instant, const State& y, Accounts& accounts);
  // take(), once per instant, if the state's numbers are finite.
  void take_once(Instant instant, const State& y, Accounts& accounts);
  // Takes a state into the envelope and the shapes: at once, or with others that wait.
  void take(const Instant& instant, const State& y, Accounts& accounts);
  void take_waiting();
  // Takes the state that the field holds.
  void take_field(const Instant& instant);
  void widen(const Instant& instant);
  void add_row(double time, double position, double sense, std::size_t station);
  void add_rest(const State& y, Accounts& accounts);

  struct Point {
    double position;
    SparseFunctional displacement;
  };

  const StruckBeam& beam_;
  const Beam& material_;
  double end_time_;  // s
  Instants shapes_, regular_;
  Result& result_;
  RowSink& rows_;
  BeamField field_;
  std::optional<SupportReactions> reactions_;  // of a beam with supports
  std::vector<Point> points_;
  struct GaugeReading {
    CurvatureAt curvature;
    double distance;  // of the fibre from the axis, m; on the back below 0
  };
  std::vector<GaugeReading> gauges_;
  std::vector<EnvelopeRow> envelope_;  // of the stations
  std::vector<Instant> waiting_;
  BeamField::States shapes_waiting_, others_waiting_;  // of those instants
  double last_shape_time_ = -1.0;                      // s
  double last_followed_time_ = -1.0;                   // s
};

}  // namespace subimpact
