#pragma once

/// Cost against error, method by method and setting by setting.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "subimpact/study/judgement/event_errors.h"

namespace subimpact {

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
/// ends when the next setting
/// would take longer than `point_seconds` (this setting is reported as not run), or when its errors
/// fall to those of the reference. Throws InvalidCase, for methods before anything is run.
WorkPrecision work_precision(const Case& input, const WorkPrecisionOptions& options = {});

/// The cheapest setting for each of recommended_errors: all sub-impacts correspond, and no event
/// time is off by more.
std::vector<Recommendation> recommendations_from(const std::vector<Trial>& points);

/// By which factor errors grow over the scene: the median, over the points that are right, of the
/// last event's error divided by that of the first. Nothing without such points.
std::optional<double> error_growth(const std::vector<Trial>& points);

}  // namespace subimpact
