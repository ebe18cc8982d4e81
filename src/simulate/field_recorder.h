#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "subimpact/simulate/result.h"
#include "system/beam_field.h"
#include "system/support_reactions.h"

namespace subimpact {

/// Which fields along the beam a run keeps.
struct FieldOptions {
  double shape_interval = 0.0;     ///< s; 0: no shapes, no envelope
  std::size_t most_points = 0;     ///< of a shape
  std::vector<double> points;      ///< x of those whose motion is kept, m
  bool reactions = false;          ///< whether there are history rows, which hold them
  double end_time = 0.0;           ///< s
  double length = 0.0;             ///< m
  double thickness = 0.0;          ///< m
  double struck_at = 0.0;          ///< m
  double shear_flexibility = 0.0;  ///< E I/(k G A), m2; 0: sections do not shear
  double yield_curvature = 0.0;    ///< 1/m; infinite: no plastic zones
};

/// Records shapes, envelope, permanent set, plastic zones, support reactions and the motion of
/// points. Shapes are of regular instants and of the events of the contact. The envelope follows
/// the history rows, some 4000 of them at most, and all shapes.
class FieldRecorder {
 public:
  /// `beam` and `result` must outlive this.
  FieldRecorder(const StruckBeam& beam, const FieldOptions& options, Result& result);

  /// Whether there is anything to record.
  bool is_needed() const { return has_shapes() || !points_.empty() || reactions_; }

  /// Rows go to `rows` in place of the result.
  void send_rows_to(RowSink& rows) { rows_ = &rows; }

  /// Of the next shape, s; infinite: none.
  double next_shape() const;
  /// Keeps the shape of a state, once per instant, if its numbers are finite. `accounts`: of the
  /// histories that hold at y.
  void add_shape(double time, const State& y, Accounts& accounts);
  /// At every history row: the motion of the points, and the envelope.
  void follow(double time, const State& y, Accounts& accounts);
  void add_reactions(HistoryRow& row, const State& y, Accounts& accounts) const;
  /// At the end: the envelope and, of a state that `is_good`, the last shape and what is left of
  /// bending.
  void finish(double time, const State& y, Accounts& accounts, bool is_good);

 private:
  bool has_shapes() const { return field_.size() > 0 && options_.shape_interval > 0.0; }
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
  FieldOptions options_;
  Result& result_;
  RowSink* rows_ = nullptr;
  BeamField field_;
  std::optional<SupportReactions> reactions_;  // of a beam with supports
  std::vector<Point> points_;
  std::vector<EnvelopeRow> envelope_;  // of the stations
  long next_shape_ = 0;
  double last_shape_time_ = -1.0;     // s
  double last_followed_time_ = -1.0;  // s
};

}  // namespace subimpact
