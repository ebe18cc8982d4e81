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

/// Records shapes, envelope, permanent set, plastic zones, support reactions and the motion of
/// points. Shapes are of regular instants and of the events of the contact. The envelope follows
/// the history rows, some 4000 of them at most, and all shapes.
class FieldRecorder {
 public:
  /// `rows` takes the rows. All must outlive this.
  FieldRecorder(const RunParts& parts, Result& result, RowSink& rows);

  bool is_needed() const { return has_shapes() || !points_.empty() || reactions_; }

  /// Of the next shape, s; infinite: none.
  double next_shape() const;
  /// Keeps the shape of a state, once per instant, if its numbers are finite. `accounts`: of the
  /// histories that hold at y.
  void add_shape(double time, const State& y, Accounts& accounts);
  /// At every history row: the motion of the points, and the envelope.
  void follow(double time, const State& y, Accounts& accounts);
  void add_reactions(HistoryRow& row, const State& y, Accounts& accounts) const;
  /// At the end: the envelope and, of a state that `is_good`, the last shape and the bending left.
  void finish(double time, const State& y, Accounts& accounts, bool is_good);
  /// Of the stations, so far.
  const std::vector<EnvelopeRow>& envelope() const { return envelope_; }
  /// Goes on from the time (s) and envelope that another recorder had reached.
  void resume(double time, const std::vector<EnvelopeRow>& envelope);

 private:
  bool has_shapes() const { return field_.size() > 0 && shape_interval_ > 0.0; }
  void add_points(double time, const State& y);
  // The field must have been read.
  void widen_envelope(double time);
  void add_row(double time, double position, double sense, std::size_t station, const State& y);
  void add_rest(const State& y, Accounts& accounts);

  struct Point {
    double position;
    SparseFunctional displacement;
  };

  const StruckBeam& beam_;
  const Beam& material_;
  double end_time_;        // s
  double shape_interval_;  // s
  Result& result_;
  RowSink& rows_;
  BeamField field_;
  std::optional<SupportReactions> reactions_;  // of a beam with supports
  std::vector<Point> points_;
  std::vector<EnvelopeRow> envelope_;  // of the stations
  long next_shape_ = 0;
  double last_shape_time_ = -1.0;     // s
  double last_followed_time_ = -1.0;  // s
};

}  // namespace subimpact
