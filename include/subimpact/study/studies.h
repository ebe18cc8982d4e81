#pragma once

/// Studies of a case by many runs: methods, theories and laws compared; cost against error, method
/// by method and setting by setting; and where and how runs fail.

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "subimpact/study/judgement/event_errors.h"

namespace subimpact {

/// One method's run, compared with the reference run; Setting::method is the name as given.
struct ComparedRun : Trial {
  Result result;
  std::vector<MatchedPair> pairs;  ///< reference (first) against this run (second)
};

struct Comparison {
  Reference reference;  ///< with error bars
  std::vector<ComparedRun> runs;
  bool interrupted = false;  ///< `runs` are those that had ended; none: the reference had not
};

/// Runs a scene by several methods (as for parse_method_name()), each with the case's step if one
/// is given, else with its tolerance or the default step, without history rows, and compares them
/// with run_reference() at rtol = 1e-11. Throws InvalidCase, also for unknown methods, a step or an
/// order that a method does not have, and a reference that fails.
Comparison compare(const Case& input, const std::vector<std::string>& methods,
                   const std::function<void(const std::string& name)>& announce = {},
                   const Progress& progress = {});

/// The run of one model of a scene, with its own error bars, compared with that of the first model.
struct ModelRun {
  std::string name;  ///< of the beam theory or contact law by which the models differ
  Result result;
  std::vector<MatchedPair> pairs;  ///< the first model's (first) against this run (second)
};

/// The case with the contact law of that name ("sphere"), without the contact constants that this
/// law does not use. Throws InvalidCase for an unknown name.
Case with_contact_law(const Case& input, const std::string& name);

/// Runs a scene by several models: cases that differ only in beam theory or contact law, and their
/// names. `announce` is called with the index of each run that begins. Where `progress` ends the
/// comparison, the runs are those that had ended. Throws InvalidCase before anything is run.
std::vector<ModelRun> compare_models(std::span<const Case> cases,
                                     std::span<const std::string> names, Jobs jobs,
                                     const std::function<void(std::size_t)>& announce = {},
                                     const Progress& progress = {});

/// The cheapest setting for a wanted error.
struct Recommendation {
  double wanted = 0.0;         ///< s
  std::optional<Trial> point;  ///< nothing if no setting meets it
  /// Set if `point` meets the error only by chance, because a finer setting of its method misses
  /// it: the cheapest setting of any method whose finer settings all meet it too.
  std::optional<Trial> steady;
};

/// What bounds the orders of event times, whatever the method.
enum class OrderBound {
  none,
  contact,        ///< the force rises as lambda^n from the touch, n not whole: n + 1
  interpolation,  ///< forces change within steps, whose events are interpolated
  library,        ///< events lie on a dense output of degree 4
  sections        ///< sections begin and cease to flow within steps
};

/// The order of event times at fixed steps, of one method.
struct MethodOrder {
  std::string method;
  int smooth = 0;                  ///< of the method where forces are smooth
  std::optional<double> observed;  ///< with the shortest steps that show one
  OrderBound bound = OrderBound::none;
  std::optional<double> most;  ///< as steps shrink, if the bound is below `smooth` and known
};

struct WorkPrecision {
  std::string label;  ///< of the chart: how this case differs from others in it
  Reference reference;
  std::vector<Trial> points;
  std::vector<MethodOrder> orders;  ///< of methods that keep a fixed step, and so have one
  bool interrupted = false;
};

/// Errors of event times for which settings are recommended, s.
inline constexpr std::array recommended_errors = {1e-6, 1e-7, 1e-8, 1e-9};

struct WorkPrecisionOptions {
  std::vector<std::string> methods;  ///< empty: default_methods()
  double point_seconds = 10.0;       ///< a setting that would take longer is not run
  double timing_budget = 0.6;        ///< s, of the repeats of one setting
  int most_repeats = 7;
  std::function<void(const WorkPrecision&)> finished;  ///< called after each point
  /// Called before each run, with its description.
  std::function<void(const std::string& what)> announce;
  Progress progress;  ///< of a single run; false ends the study with the results so far
};

/// Sweeps every method from coarse to fine against a reference of its own, tolerances first, then
/// fixed steps. Timed runs are made one at a time; the shortest of several repeats counts. A sweep
/// ends when the next setting would take longer than `point_seconds`, or when its errors fall to
/// those of the reference. Throws InvalidCase, for methods before anything is run.
WorkPrecision work_precision(const Case& input, const WorkPrecisionOptions& options = {});

/// The cheapest setting for each of recommended_errors: all sub-impacts correspond, and no event
/// time is off by more.
std::vector<Recommendation> recommendations_from(const std::vector<Trial>& points);

/// By which factor errors grow over the scene: the median, over the points that are right, of the
/// last event's error over that of the first. Nothing without such points.
std::optional<double> error_growth(const std::vector<Trial>& points);

/// Whether a list of methods includes this one: a name without a table stands for all its tables,
/// an empty list for all methods.
bool asked_for(const std::vector<std::string>& methods, const std::string& method);

struct OutcomePoint : Trial {
  std::string row;  ///< method, and what else sets the row apart
  double x = 0.0;   ///< omega_max h of a fixed step, or rtol
};

struct OutcomeMap {
  Reference reference;
  std::vector<OutcomePoint> points;
};

/// Methods against fixed steps, from far below to far beyond the stable ones, and against
/// tolerances; backward differentiation order by order. A run that takes more than `run_seconds` by
/// the clock is left out. `jobs` runs go at a time (0: one for each processor). `progress` is
/// called with the numbers of finished and of all runs; false: no more begin.
using Count = std::function<bool(std::size_t done, std::size_t all)>;
OutcomeMap outcome_map(const Case& input, const std::vector<std::string>& methods = {},
                       double run_seconds = 20.0, Jobs jobs = 0, const Count& progress = {});

}  // namespace subimpact
