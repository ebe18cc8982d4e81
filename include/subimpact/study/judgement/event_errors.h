#pragma once

/// Methods and their settings, sub-impacts of two runs in pairs, and errors of event times against
/// a reference.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "subimpact/study/judgement/judgement.h"

namespace subimpact {

/// The parts of "erk:dop853+library": a method, a table of coefficients after a colon, and a
/// treatment of events (solver.events) after a plus sign. The last two may be left out.
struct MethodName {
  std::string method;
  std::optional<std::string> table, events;
};
MethodName parse_method_name(const std::string& name);

struct Setting {
  std::string method;       ///< "erk:dop853"; a method without tables alone
  bool fixed_step = false;  ///< else it is rtol
  double value = 0.0;       ///< s, or the tolerance

  std::string text() const;  ///< "rtol 1e-08", "step 0.2556 us"
  bool operator==(const Setting&) const = default;
};

/// The case with that setting. Throws InvalidCase for an unknown method.
Case with_setting(const Case& input, const Setting& setting);

/// From coarse to fine: by methods with error control rtol from 1e-2 to 1e-12 in decades, then, by
/// methods that take a fixed step, halved steps from the longest that the method may be stable at
/// down to 1/256 of 0.9 of the critical step of central differences. Throws InvalidCase for an
/// unknown method or table, and where the method cannot run the case.
std::vector<Setting> settings_of(const Case& input, const std::string& method);

/// The methods of a sweep by default: every method that can run the case, with its relevant tables.
std::vector<std::string> default_methods(const Case& input);

/// A sub-impact of one run and the one of another run that corresponds to it; one may be missing.
struct MatchedPair {
  std::optional<std::size_t> first, second;  ///< indices into the two lists
};

/// Pairs the sub-impacts of two runs of one scene, in order of time. Two correspond if each
/// overlaps the other more than it overlaps any other one, and their starts or ends are closer than
/// half of the longer duration.
std::vector<MatchedPair> match_sub_impacts(const std::vector<SubImpact>& first,
                                           const std::vector<SubImpact>& second);

/// How many leading sub-impacts of the two lists correspond one to one.
std::size_t n_leading_matches(const std::vector<MatchedPair>& pairs);

/// The first sub-impact that only one of two runs has.
struct UnmatchedSubImpact {
  double start = 0.0;       ///< s
  double duration = 0.0;    ///< s
  std::string description;  ///< in words; the first run is called the reference
};

/// A time compared with which errors of a sub-impact must be small.
struct LengthBeside {
  Reason::Kind kind;  ///< duration, separation_before or separation_after
  double length;      ///< s
};

/// The duration of a sub-impact (if it has ended) and the separations before and after it.
std::vector<LengthBeside> lengths_beside(const std::vector<SubImpact>& all, std::size_t number);

/// The sub-impacts of another run that correspond to those of a base run, one to one.
struct Counterparts {
  /// By number in the base run; null where contacts have merged, split or vanished. They point into
  /// the list of the other run.
  std::vector<const SubImpact*> of;
  /// By number in the base run: whether the other run has a new contact before it.
  std::vector<bool> follows_new_one;
};

Counterparts counterparts(const std::vector<SubImpact>& base, const std::vector<SubImpact>& other);

/// The sub-impact (from 0) from which on a run is uncertain if its near miss may have been an
/// event: the one that nearly opens, or the one after the separation that nearly closes.
std::size_t first_in_doubt(const Result& run, const NearMiss& near_miss);

/// For each near miss of a run the index of the corresponding near miss of another run, or none: of
/// the same kind, in the same contact or separation, each the nearest in time to the other; up to
/// the separation after the first `n_matched` sub-impacts.
std::vector<std::optional<std::size_t>> match_near_misses(const Result& run, const Result& other,
                                                          std::size_t n_matched);

/// The event times of a case's semi-discrete equations, as accurate as the program can compute
/// them: errors of the time integration are measured against these.
struct Reference {
  Case input;                          ///< of the run; ends at the horizon
  Result result;                       ///< up to the horizon
  Result other;                        ///< of the second method, against which errors of the first
                                       ///< one's own run are measured
  std::vector<SubImpact> sub_impacts;  ///< those that count, with their stated errors
  double error = 0.0;                  ///< s, the largest error stated for them
  double horizon = 0.0;                ///< s, up to which runs are compared
  std::string horizon_reason;          ///< in words
  std::string description;             ///< the two runs, in words
};

/// Two runs of a case up to its end, by methods of different kinds, in parallel on two cores:
/// `nystrom` and `erk`; where damping rules these out, `erk` and `exponential`, or if sections
/// yield two tables of `erk`. The error stated for an event follows from the difference of the two
/// (study/judgement.h). Throws InvalidCase if either fails.
Reference run_reference(const Case& input, double rtol, const Progress& progress = {},
                        Jobs jobs = 2);

/// The same at rtol = 1e-12, up to a horizon: the middle of the separation after the last
/// sub-impact that counts, or the case's end. A sub-impact counts if it is certain and its stated
/// error is at most `largest_error` (s): sub-impacts that graze amplify small differences until no
/// computation can predict the next event. Throws InvalidCase if nothing counts too.
Reference compute_reference(const Case& input, double largest_error, const Progress& progress = {},
                            Jobs jobs = 2);

/// How far a run is from a reference. Times are those of the starts and ends of the leading
/// sub-impacts that correspond one to one; the first start, which is given, is left out.
struct EventErrors {
  std::size_t n_reference = 0;      ///< sub-impacts that count
  std::size_t n_found = 0;          ///< of the run, before the horizon
  std::size_t n_corresponding = 0;  ///< leading ones
  std::size_t n_times = 0;          ///< times compared; without any there are no errors
  double median = 0.0;              ///< s
  double maximum = 0.0;             ///< s
  double rms = 0.0;                 ///< s
  double first = 0.0;               ///< s, of the first end
  double last = 0.0;                ///< s, of the last time compared
  double starts = 0.0;              ///< s, largest of the starts
  double ends = 0.0;                ///< s, largest of the ends
  double peak_force = 0.0;          ///< largest, relative
  double impulse = 0.0;             ///< largest, relative to the largest impulse
  double striker_velocity = 0.0;    ///< at the horizon, relative to the initial velocity
  double beam_velocity = 0.0;       ///< its mean, as for the striker
  std::optional<UnmatchedSubImpact> unmatched;  ///< the first sub-impact that does not correspond

  bool all_correspond() const { return !unmatched; }
  /// A single number for charts: the largest error; where a sub-impact is lost or invented, at
  /// least the duration of that sub-impact.
  double overall() const {
    return unmatched && unmatched->duration > maximum ? unmatched->duration : maximum;
  }
};

/// For a run of the reference's scene up to its horizon.
EventErrors event_errors(const Result& run, const Reference& reference);

/// Errors against any list of sub-impacts; velocities are left at 0.
EventErrors event_errors(const std::vector<SubImpact>& run,
                         const std::vector<SubImpact>& reference);

/// The verdict on a run compared with a reference.
enum class Verdict {
  right,        ///< completed, and every sub-impact corresponds
  wrong_count,  ///< completed, but sub-impacts are missing, merged or invented
  inaccurate,   ///< ended by one of its own checks, and the outcome reports it
  unstable,     ///< the solution grew without bound, and the outcome reports it
  failed,       ///< the solver could not continue, and the outcome reports it
  refused,      ///< the setting was not accepted
  not_run       ///< not run: it would have taken longer than allowed
};

std::string_view to_string(Verdict verdict);

/// The verdict on a run that was accepted.
Verdict judge(const Result& run, const EventErrors& errors);

/// A variant of a case, run and judged by a reference; compare, work-precision and stability
/// list such trials.
struct Trial {
  Setting setting;
  Case input;
  Verdict verdict = Verdict::not_run;
  std::string message;  ///< why it is not right, in words
  EventErrors errors;   ///< where has_errors()
  Work work;
  double seconds = 0.0;  ///< wall time of one run, set-up included
  int repeats = 0;
  double energy_error = 0.0;  ///< largest relative one of the run
  /// At a fixed step: ln(e'/e)/ln(h'/h) with the errors (root mean square) of this step h and of
  /// the longer one before, if both runs are right and well above the error of the reference.
  std::optional<double> order = {};

  /// Whether the run completed, and any time could be compared.
  bool has_errors() const {
    return (verdict == Verdict::right || verdict == Verdict::wrong_count) && errors.n_times > 0;
  }
  bool has_run() const { return verdict != Verdict::not_run && verdict != Verdict::refused; }
  bool reaches(double error) const { return verdict == Verdict::right && errors.maximum <= error; }
};

/// Runs `trial.input`, which ends at the reference's horizon, and judges it. An InvalidCase becomes
/// a verdict, with an empty result.
Result run_trial(Trial& trial, const Reference& reference, const Progress& progress = {});

}  // namespace subimpact
