#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "subimpact/simulate/result.h"
#include "system/beam_field.h"
#include "system/support_reactions.h"

namespace subimpact {

struct RunParts;

/// The first multiple of an interval (s) after a time, as its number.
inline long first_after(double time, double interval) {
  return static_cast<long>(std::floor(time / interval * (1.0 + 1e-12))) + 1;
}

/// Adds the multiples of an interval below `end`, from that number on.
inline void add_multiples(long number, double interval, double end, std::vector<double>& times) {
  for (; static_cast<double>(number) * interval < end; ++number) {
    times.push_back(static_cast<double>(number) * interval);
  }
}

/// Records shapes, envelope, permanent set, plastic zones, support reactions and the motion of
/// points. Shapes are of regular instants and of the events of the contact. The envelope follows
/// the history rows, some 4000 of them at most, and all shapes.
class FieldRecorder {
 public:
  /// `rows` takes the rows. All must outlive this.
  FieldRecorder(const RunParts& parts, Result& result, RowSink& rows);

  bool is_needed() const { return has_shapes() || !points_.empty() || reactions_; }

  /// Of the next regular instant of the extremes along the beam, s; infinite: none.
  double next_instant() const;
  /// Adds the regular instants from there on, below `end` (s).
  void add_instants(double end, std::vector<double>& times) const {
    if (has_shapes()) add_multiples(regular_.passed, regular_.interval, end, times);
  }
  /// Takes the extremes of that instant and, where it is due, the shape. `accounts`: of the
  /// histories that hold at y.
  void take_instant(double time, const State& y, Accounts& accounts);
  /// Keeps the shape of a state, once per instant, if its numbers are finite.
  void add_shape(double time, const State& y, Accounts& accounts);
  /// At every history row: the motion of the points, and the envelope.
  void follow(double time, const State& y, Accounts& accounts);
  void add_reactions(HistoryRow& row, const State& y, Accounts& accounts) const;
  /// At the end: the envelope and, of a state that `is_good`, the last shape and the bending left.
  void finish(double time, const State& y, Accounts& accounts, bool is_good);
  /// Of the stations, so far.
  const std::vector<EnvelopeRow>& envelope() {
    take_waiting();
    return envelope_;
  }
  /// Goes on from the time (s) and envelope that another recorder had reached.
  void resume(double time, const std::vector<EnvelopeRow>& envelope);

 private:
  bool has_shapes() const { return field_.size() > 0 && shapes_.interval > 0.0; }
  void add_points(double time, const State& y);
  // Widens the envelope, and at a `regular` instant or an event the extremes that runs beside one
  // another share, by a state: at once, or with others that wait.
  void take(double time, const State& y, Accounts& accounts, bool regular);
  void take_waiting();
  void widen(double time, bool regular);
  void read_at(double time, const State& y, Accounts& accounts, bool shape, bool regular);
  void add_row(double time, double position, double sense, std::size_t station);
  void add_rest(const State& y, Accounts& accounts);

  struct Point {
    double position;
    SparseFunctional displacement;
  };

  const StruckBeam& beam_;
  const Beam& material_;
  double end_time_;  // s
  // Multiples of an interval (s), of which so many have been passed.
  struct Instants {
    double interval;
    long passed = 0;
    double next() const { return static_cast<double>(passed) * interval; }
    bool reach(double time) {
      if (time < next() * (1.0 - 1e-12)) return false;
      ++passed;
      return true;
    }
  };
  Instants shapes_, regular_;
  Result& result_;
  RowSink& rows_;
  BeamField field_;
  std::optional<SupportReactions> reactions_;  // of a beam with supports
  std::vector<Point> points_;
  std::vector<EnvelopeRow> envelope_;  // of the stations
  struct Instant {
    double time;
    bool regular;
  };
  std::vector<Instant> waiting_;
  std::vector<double> waiting_positions_;  // of those instants, one after another
  double last_shape_time_ = -1.0;          // s
  double last_followed_time_ = -1.0;       // s
};

}  // namespace subimpact
