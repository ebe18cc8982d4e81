#pragma once

/// Options of a run: method, tolerances, events, output. Each member is a key of the case file
/// ("solver.rtol"); case_keys() (see case/case_keys.h) lists them with units, defaults and ranges.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "subimpact/simulate/error.h"

namespace subimpact {

/// Treatment of an event inside a step.
enum class EventHandling {
  located,       ///< the step is retaken to end at the event, found on the trajectory itself
  interpolated,  ///< the step is kept; the event's time is interpolated within it (the paper's
                 ///< scheme)
  library        ///< contact events by the root-finding of SUNDIALS on its own dense output;
                 ///< sections as with `located`
};

enum class ReversalHandling {
  located,  ///< section events are located, and the end of the step is corrected
  step_end  ///< history advances at step ends only
};

/// `own`: CaseParts::integrator, Problem::integrator.
enum class Method { central_difference, erk, nystrom, dirk, adams, bdf, exponential, own };

struct SolverOptions {
  Method method = Method::erk;
  double rtol = 1e-8;          ///< relative to the scene's own scales of displacement and velocity
  std::optional<double> step;  ///< s; empty: 0.9 of critical (central-difference), else adaptive
  std::optional<double> max_step;    ///< s; adaptive methods
  std::optional<std::string> table;  ///< coefficients of a Runge-Kutta method; its first if empty
  std::optional<EventHandling>
      events;  ///< empty: interpolated for central-difference, else located
  std::optional<ReversalHandling> reversals;  ///< empty: located, by adams and bdf step_end
  std::optional<int> max_order;               ///< adams and bdf; empty: default of the method
};

struct AccuracyOptions {
  /// s: bound on the error of every event time, for simulate_within() (see study/run_as_asked.h);
  /// simulate() ignores it.
  std::optional<double> event_times;
  /// Bound on the total work of all runs made to meet `event_times`, in evaluations of the
  /// right-hand side times unknowns of the beam: 1 to 3 ns each.
  double work_limit = 2e10;
  /// Largest error of the energy, relative to the initial energy, of a run that counts as
  /// completed; empty: derived from method and rtol, 1e-3 at most.
  std::optional<double> energy;
};

/// A side of the beam: the one that is struck, or the one behind.
enum class Face { front, back };

/// A strain gauge along the axis of the beam. It reads eps = kappa h/2 in front and -kappa h/2 on
/// the back, with the curvature kappa there (1/m) and the height h of the section (m), positive in
/// tension.
struct Gauge {
  double position = 0.0;  ///< x, as a fraction of the length
  Face face = Face::back;
};

enum class StopRule {
  end_time,        ///< at the end time
  no_more_contact  ///< sooner, once it is proven that no contact can follow
};

struct OutputOptions {
  /// s between history rows; 0: none; empty: a share of the run, with further rows during contact
  /// wherever the force has changed by a hundredth of the largest so far.
  std::optional<double> interval;
  double zone_gap = 0.1;         ///< in first flexural periods
  double subzone_gap = 0.02;     ///< in first flexural periods
  double opening = 0.0;          ///< m: contacts parted by less are joined; 0: none
  std::vector<double> sections;  ///< sections whose bending is kept, as fractions of the length
  std::vector<double> points;    ///< points whose motion is kept, as fractions of the length
  std::vector<Gauge> gauges;     ///< whose strains are kept
  /// s between shapes, the fields along the whole beam; 0: none, and no envelope; empty: about 400
  /// shapes, or none in a run without history rows.
  std::optional<double> shapes;
  int shape_points = 101;  ///< most points of a shape, along the whole beam

  bool has_history() const { return interval != 0.0; }
  /// s between history rows of a run that ends at `end_time` (s); 0: none.
  double history_interval(double end_time) const { return interval.value_or(end_time / 2000.0); }

  /// s between shapes of a run that ends at `end_time` (s); 0: none. If it is left open, shapes are
  /// taken at instants of history rows, so that they need no further states.
  double shape_interval(double end_time) const {
    return shapes || !has_history() ? shapes.value_or(0.0) : extremes_interval(end_time);
  }

  /// s between the regular instants at which a run and those beside it sample extremes along the
  /// beam: the default of shapes; without history rows, that of shapes.
  double extremes_interval(double end_time) const {
    const double rows = history_interval(end_time);
    return rows > 0.0 ? rows * std::max(std::round(end_time / 400.0 / rows), 1.0)
                      : shapes.value_or(0.0);
  }

  /// For runs of which only the sub-impacts are needed.
  void keep_no_rows() {
    interval = 0.0;
    sections.clear();
    points.clear();
    gauges.clear();
    shapes = 0.0;
  }
};

enum class VectorOperationsKind { project, library };

/// How central differences advance the striker over a step.
enum class StrikerUpdate {
  central,        ///< as the beam
  constant_force  ///< by the force at the step's start, constant over the step: first order
};

/// Switches for experiments with the program itself; no strike needs them.
struct StudyOptions {
  VectorOperationsKind vector_operations = VectorOperationsKind::project;
  bool pair_detection = true;  ///< look for contacts that open and close again within one step
  bool beyond_critical =
      false;  ///< allows a fixed step above the stability limit, to study the failure
  StrikerUpdate striker_update = StrikerUpdate::central;
};

struct Options {
  double end_time = 0.0;  ///< s
  StopRule stop = StopRule::end_time;
  SolverOptions solver;
  AccuracyOptions accuracy;
  OutputOptions output;
  StudyOptions study;
};

/// A table of coefficients that solver.table may name.
struct MethodTable {
  Method method;  ///< the method to which the table belongs
  std::string name;
  int order;
  int embedded_order;  ///< of the error estimate
  int evaluations;     ///< right-hand sides an accepted step costs; for an implicit method its
                       ///< stages, each of which is evaluated two or three times
  std::string note;    ///< its purpose and source
};

/// All tables; the first of each method is its default.
const std::vector<MethodTable>& method_tables();

}  // namespace subimpact
