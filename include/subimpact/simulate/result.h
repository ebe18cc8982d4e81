#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "subimpact/ode/work_counts.h"
#include "subimpact/simulate/assessment.h"
#include "subimpact/simulate/options.h"
#include "subimpact/simulate/records.h"
#include "subimpact/system/readings.h"

namespace subimpact {

struct EndState;

/// One row of history.csv; the members are its columns, in SI units.
struct HistoryRow {
  double time;
  double force;
  double indentation;
  double struck_displacement;   ///< w_c
  double striker_displacement;  ///< w_m
  double struck_deflection;     ///< f_c = w_c - w(0)
  double striker_relative;      ///< u_mf = w_m - w(0)
  double struck_velocity;       ///< v_c
  double striker_velocity;      ///< v_m
  double back_stress;           ///< Pa, positive in tension
  double striker_energy;        ///< U_m
  double beam_kinetic_energy;   ///< U_k
  double bending_elastic;       ///< U_e, with that of supports
  double bending_plastic;       ///< U_p
  double contact_elastic;       ///< U_c
  double contact_plastic;       ///< D_c
  double energy_error;          ///< (sum of the seven - initial)/initial
  /// (momentum - initial)/initial, including the momentum lost to damping by mass; none where
  /// supports take momentum up.
  std::optional<double> momentum_error;
  double beam_damping = 0.0;  ///< D_b
  double work = 0.0;          ///< W
  /// N, of the supports on the beam, positive in the direction of the strike; none at a free end.
  std::optional<double> first_reaction, last_reaction;
  std::vector<double> gauge_strains;  ///< of output.gauges, in that order; tension: above 0
};

/// One row of sections.csv: a section whose bending is kept, at the time of a history row.
struct SectionRow {
  double time;               ///< s
  double position;           ///< x of the section, m
  double curvature;          ///< kappa, 1/m
  double moment;             ///< M, N m; E I kappa while elastic
  double plastic_curvature;  ///< kappa - M/(E I), 1/m
  double strain;             ///< -kappa h/2, of the outer fibre behind; tension: above 0
};

/// One row of points.csv: a point of the beam's axis at the time of a history row.
struct PointRow {
  double time;          ///< s
  double position;      ///< x, m
  double displacement;  ///< m
  double velocity;      ///< m/s
};

/// One row of shapes.csv: a point of the whole beam at one instant.
struct ShapeRow {
  double time;               ///< s
  double position;           ///< x, m
  double displacement;       ///< w, m
  double velocity;           ///< m/s
  double rotation;           ///< of the section, rad; dw/dx where sections do not shear
  double curvature;          ///< kappa, 1/m
  double moment;             ///< M, N m
  double plastic_curvature;  ///< kappa - M/(E I), 1/m
};

/// One row of envelope.csv: the extremes at a point of the beam over the run.
struct EnvelopeRow {
  struct Extreme {
    double value = 0.0;
    double time = 0.0;  ///< s
  };
  struct Range {
    Extreme smallest, largest;
    void include(double value, double time) {
      if (value < smallest.value) smallest = {value, time};
      if (value > largest.value) largest = {value, time};
    }
    double magnitude() const { return std::max(std::abs(largest.value), std::abs(smallest.value)); }
  };
  double position = 0.0;       ///< x, m
  Range displacement;          ///< m
  Range moment;                ///< N m
  Range strain;                ///< -kappa h/2, of the outer fibre behind; tension: above 0
  Range plastic_curvature;     ///< 1/m
  double permanent_set = 0.0;  ///< m: displacement at rest against the chord
  /// m: the same against the supports, which differs for a cantilever: against its clamp.
  double set_from_supports = 0.0;
};

/// The largest magnitude of a quantity along the beam, sampled at single instants.
struct SampledPeak {
  double shared = 0.0;   ///< over events and the regular instants that all runs of a case share
  double largest = 0.0;  ///< over all instants at which fields are sampled
  double before = 0.0, after = 0.0;  ///< at the instants next to that of the largest
  double last = 0.0;                 ///< at the last instant
  bool is_last = false;              ///< the largest was found at the last instant

  void follow(double magnitude, bool regular) {
    if (regular && magnitude > shared) shared = magnitude;
    if (is_last) after = magnitude;
    is_last = magnitude > largest;
    if (is_last) {
      largest = after = magnitude;
      before = last;
    }
    last = magnitude;
  }
  /// Bound on how far a parabola through the largest and its neighbours may rise above it.
  double sampling_error() const { return (2.0 * largest - before - after) / 8.0; }
};

struct FieldPeaks {
  SampledPeak displacement;  ///< m
  SampledPeak moment;        ///< N m
  SampledPeak strain;        ///< of the outer fibre
  /// N, of the forces of the supports along the strike and against it, as magnitudes.
  SampledPeak reaction_along, reaction_against;
};

/// One row of strikes.csv: one of several strikes on a beam, at its end.
struct StrikeRow {
  int strike = 0;                     ///< from 1
  std::size_t sub_impacts = 0;        ///< their number
  std::optional<double> restitution;  ///< as Result::restitution
  double striker_velocity = 0.0;      ///< m/s
  double peak_force = 0.0;            ///< N
  double impulse = 0.0;               ///< N s
  double dent = 0.0;                  ///< m, residual, of all strikes so far
  double permanent_set = 0.0;         ///< m, largest against the supports, of all strikes so far
  double hinge_rotation = 0.0;        ///< rad, largest, of all strikes so far
  double striker_energy = 0.0;        ///< J, left in the striker
  double vibration = 0.0;             ///< J, of the beam, with energy locked in bent sections
  double bending_dissipated = 0.0;    ///< J, by this strike
  double contact_dissipated = 0.0;    ///< J, by this strike
  std::optional<double> restitution_error, peak_force_error, permanent_set_error;
};

/// Receives the rows of a run as they are made, so that they need not be held in memory. Called in
/// the order of the files, in the thread of the run.
class RowSink {
 public:
  virtual ~RowSink() = default;
  virtual void add(const HistoryRow& row) = 0;
  /// The sections of output.sections, at the time of the previous history row.
  virtual void add(const SectionRow& row) = 0;
  /// The points of output.points, at the time of the previous history row.
  virtual void add(const PointRow& /*row*/) {}
  /// The points of a shape, one after another in ascending order of x; maybe after later rows of
  /// other kinds.
  virtual void add(const ShapeRow& /*row*/) {}
  /// Whether the points of shapes are computed at all.
  virtual bool takes_shapes() const { return true; }
};

enum class OutcomeKind {
  completed,      ///< the end was reached, and all checks of energy, momentum and events passed
  stopped,        ///< the caller's progress function returned false
  inaccurate,     ///< energy, momentum, an impulse or an event was off by more than the tolerance
  unstable,       ///< the energy grows without bound, or a value is not finite
  chattering,     ///< the contact opened and closed many times while time hardly advanced
  solver_failed,  ///< the integrator could not continue
  left_validity,  ///< the indentation reached the beam's thickness
};

/// The outcome in one word: "completed", "unstable", ...
std::string_view to_string(OutcomeKind kind);

/// From the last time at which a check passed to the first at which it failed.
struct Interval {
  double from = 0.0;  ///< s
  double to = 0.0;    ///< s
};

struct Outcome {
  OutcomeKind kind = OutcomeKind::completed;
  double time = 0.0;    ///< s, reached
  std::string message;  ///< one line: for failures, cause and what to do
  /// For `inaccurate` and `unstable`: where results stop being right; up to `from` every check
  /// passed.
  std::optional<Interval> first_failure;
  bool completed() const { return kind == OutcomeKind::completed; }
};

/// The settings of a run: choices that the case left open, and derived quantities.
struct ResolvedSettings {
  bool half_model = false;
  std::size_t n_unknowns = 0;  ///< of the beam
  std::size_t n_sections = 0;
  bool bends() const { return n_sections > 1; }
  std::string mesh;                    ///< in words
  std::string contact_law;             ///< its name
  std::string section;                 ///< name of the bending law; "elastic" where it never yields
  double highest_frequency = 0.0;      ///< rad/s, bound
  double largest_contact_slope = 0.0;  ///< N/m, dF/dlambda that the strike's energy allows
  /// rad/s, of beam and striker joined by a spring of that slope; at least highest_frequency.
  double joined_frequency = 0.0;
  double contact_time = 0.0;         ///< s, scale of the shortest contacts
  double contact_mass_share = 0.0;   ///< of the striker in the mass that such contacts move at once
  double critical_step = 0.0;        ///< s, of central differences: 2/joined_frequency
  std::optional<double> step;        ///< s, of fixed-step methods
  std::optional<std::string> table;  ///< coefficients, of Runge-Kutta methods
  EventHandling events = EventHandling::located;
  ReversalHandling reversals = ReversalHandling::located;
  std::optional<int> max_order;     ///< of multistep methods
  double position_tolerance = 0.0;  ///< m, adaptive methods
  double velocity_tolerance = 0.0;  ///< m/s
  double contact_stiffness = 0.0;   ///< K, N/m^contact_exponent
  double contact_exponent = 1.5;    ///< of the indentation in the contact force
  double yield_indentation = 0.0;   ///< m, at which a contact without history first yields
  double yield_curvature = 0.0;     ///< 1/m
  double first_period = 0.0;        ///< T1 of the beam in bending, s
  double initial_energy = 0.0;      ///< J
  double energy_tolerance = 0.0;    ///< relative to the initial energy
  double shape_interval = 0.0;      ///< s between shapes; 0: none
  std::size_t n_shape_points = 0;   ///< points of a shape, along the whole beam
  double memory = 0.0;              ///< bytes that a run takes, roughly
  /// Cost of the natural modes, as the number of entries of right-hand sides that take as long to
  /// compute; 0: not needed.
  double decomposition = 0.0;
};

/// A command that goes on from here.
struct NextStep {
  std::string command;  ///< as the shell takes it
  std::string gain;     ///< what it shows, and how long it takes
};

/// The cost of a run: of the integration (including mass solves and right-hand sides of the beam)
/// and of event location.
struct Work : WorkCounts {
  long roots = 0;          ///< events located
  long section_flows = 0;  ///< sections that flowed, summed over steps
  double setup_seconds = 0.0;
  double wall_seconds = 0.0;  ///< whole, set-up included
  double all_seconds = 0.0;   ///< with the runs beside and before it; 0: there were none
};

/// What one run computes. Its base is what studies of several runs add.
struct Result : Assessment {
  Outcome outcome;
  Options given;          ///< of the run, as passed by the caller
  ResolvedSettings used;  ///< the same after resolve()
  std::vector<SubImpact> sub_impacts;
  std::vector<Transition> transitions;
  std::vector<SupportContact> support_contacts;  ///< in order of start, then of position
  /// In order of time: for every contact and separation the nearest few whose margin is below half
  /// of the largest distance there; for a free flight that the exponential method passes in one
  /// step, the nearest.
  std::vector<NearMiss> near_misses;
  std::vector<HistoryRow> history;          ///< empty if a RowSink took the rows
  std::vector<SectionRow> section_history;  ///< of output.sections, in that order at each time
  std::size_t n_history_rows = 0;           ///< wherever they went
  std::vector<PointRow> point_history;      ///< of output.points, in that order at each time
  std::vector<ShapeRow> shapes;             ///< empty if a RowSink took the rows
  std::size_t n_shape_rows = 0;             ///< wherever they went
  std::vector<EnvelopeRow> envelope;        ///< in ascending order of x; with shapes
  FieldPeaks peaks;                         ///< with shapes
  /// N, extremes of the forces of the supports at x = 0 and x = l on the beam, positive along the
  /// strike, over history rows, shapes and events; none at a free end.
  std::array<std::optional<EnvelopeRow::Range>, 2> reactions;
  /// All strikes of a beam that was struck several times; other members describe the last strike.
  std::vector<StrikeRow> strikes;
  /// The plastic hinges of the whole beam at the end, in ascending order of x; with shapes.
  std::vector<PlasticZone> plastic_zones;
  std::optional<double> first_section_yield;  ///< s, interpolated within a step
  std::optional<double> first_contact_yield;  ///< s
  /// s: a time after which it is proven that no contact follows: the end of the run, or sooner with
  /// time.stop = "no-more-contact".
  std::optional<double> no_more_contact;
  /// Whether it is proven, for the run and for those beside it, that no contact follows.
  bool contact_over = false;
  /// In the flight after the last sub-impact; none if the gap only grows.
  std::optional<ClosestApproach> closest_approach;
  std::size_t n_yielded_sections = 0;  ///< of the sections modelled
  double max_force = 0.0;              ///< N
  double max_indentation = 0.0;        ///< m
  double largest_rotation = 0.0;       ///< rad, of sections, at separations and at the end
  /// Whether sections turn so far that the numbers are no results: the model is for small
  /// rotations.
  bool turns_too_far() const { return largest_rotation > 0.5; }
  double largest_displacement = 0.0;  ///< m, of the struck point, at these and at rows
  double striker_velocity = 0.0;      ///< m/s, at the end
  double beam_mean_velocity = 0.0;    ///< m/s, at the end: beam momentum over beam mass
  /// Velocities (m/s), at a time (s), of the striker and, at the struck point, of the rigid body
  /// that has the beam's momentum and moment of momentum: its mean if it is struck at mid-span.
  struct Velocities {
    double time = 0.0, striker = 0.0, beam = 0.0;
  };
  Velocities first_touch;  ///< as they first met
  Velocities parting;      ///< at the last separation, or at the end where there was none
  /// Coefficient of restitution: (beam - striker) at parting over (striker - beam) at first touch.
  /// None if the bodies never touched, or touched at rest.
  std::optional<double> restitution;
  /// s: the start of a contact in which gravity holds the striker on the beam to the end of the run
  /// and beyond.
  std::optional<double> rests_since;
  Energies final_energies;                   ///< J, at the end
  double max_energy_error = 0.0;             ///< largest relative error over all checks
  std::optional<double> max_momentum_error;  ///< none where supports take momentum up
  double contact_damping_loss = 0.0;         ///< J, dissipated by the damping of the contact
  double beam_damping_loss = 0.0;            ///< J, by that of the beam
  /// Largest difference between the impulse and the integrated force of a sub-impact, over m v0.
  double max_impulse_error = 0.0;
  /// The beam at the end of the run, for another strike on it; null for a failed run.
  std::shared_ptr<const EndState> end_state;
  /// Warnings about results that passed all checks, one sentence each.
  std::vector<std::string> warnings;
  std::vector<NextStep> next_steps;  ///< of `subimpact run` alone
  std::vector<Answer> answers;       ///< in the order of the screen; empty until they are made
  StrikeVerdict verdict;
  Work work;

  /// Whether the whole result passed every check. If not, the part up to
  /// outcome.first_failure->from did.
  bool is_usable() const { return outcome.completed() || outcome.kind == OutcomeKind::stopped; }
  /// The end of a sub-impact, s; the end of the run if it was still open.
  double end_of(const SubImpact& s) const { return s.end.value_or(outcome.time); }
  /// The sum over all sub-impacts, N s.
  double impulse() const;
  /// How many sub-impacts are certain. None without an error estimate.
  std::optional<std::size_t> n_certain() const;

  /// One line: outcome, sub-impacts, error of the energy, steps and time.
  std::string brief_report() const;
};

}  // namespace subimpact
