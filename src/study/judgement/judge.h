#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "subimpact/study/judgement/judgement.h"

namespace subimpact {

/// Multiplies safety factors where one run alone shows a part of the error.
inline constexpr double single_run_factor = 1.5;

/// Whether runs show an error of the mesh.
bool of_mesh(std::span<const RunBeside> beside);

/// Judges a run by the runs that show one part of its error: errors of its times and values, and
/// why a sub-impact or a flight is not certain. Event 2 i is the start of sub-impact i, 2 i + 1 its
/// end. The run and those beside it must outlive the judge.
class Judge {
 public:
  /// An error that is not known.
  static constexpr double unknown = std::numeric_limits<double>::infinity();

  /// Factors of the errors of times, of values, and of the indentation where it tells existence.
  struct Safety {
    double time, value, existence;
  };

  Judge(const Case& input, const Result& run, std::span<const RunBeside> beside);

  /// Error (s) of the time of an event.
  double time_error(std::size_t event) const;

  /// Error of a value: at least the median of the errors around it, because single differences may
  /// be small by chance. `least`: the smallest error to be stated.
  using Value = std::function<std::optional<double>(const SubImpact&)>;
  double value_error(std::size_t i, const Value& value, double least = 0.0) const;

  /// Error (m) of the opening after a sub-impact: at least the median of the relative errors around
  /// it, because openings of all sizes follow each other, and the error of the indentation.
  double opening_error(std::size_t i) const;

  /// Errors of the largest indentation (m) and force (N) due to the error of the indentation.
  double least_indentation_error(std::size_t i) const;
  double least_force_error(std::size_t i) const;

  /// Why a sub-impact is not certain; none if it is. `strictness` multiplies errors.
  std::optional<Reason> doubt_of(std::size_t i, double strictness) const;

  /// Why the flight after a sub-impact may hold another one; none if it does not.
  std::optional<Reason> doubt_of_flight(std::size_t i) const;

  /// Error (m) of the closest approach after the last sub-impact, or in a run without sub-impacts.
  double approach_error() const;

  /// The share of the runs that have it, with one run more that does not.
  double probability(std::size_t i) const;

 private:
  struct Partner {
    const SubImpact* there = nullptr;  // none: it has no counterpart
    bool alone = true;  // no other one overlaps either of the two, and both end or neither does
  };

  // The counterparts of the sub-impacts of a run in another one, and those that have none here.
  struct Partners {
    std::vector<Partner> of;
    std::vector<const SubImpact*> extra;
  };

  // A start or an end; the error before safety.
  struct Event {
    double time = 0.0;
    double rate = 0.0;  // m/s, of the indentation
    double error = 0.0;
    bool known = false;
  };

  // Where the mesh is fine, at most twice the median of those around it: a graze is known by its
  // depth, not by its time.
  double usual_time_error(std::size_t event) const;
  static Partners partners_in(const Result& run, const Result& other);
  void set_events();
  // The sub-impact of a run beside that shows errors of one; none: it has none.
  const SubImpact* shown_by(std::size_t k, std::size_t i) const;
  // Of a difference of that sub-impact to a run beside: more of it is error where no far run has
  // it.
  double gain(std::size_t k, std::size_t i) const;
  // Whether a run beside would have sub-impact i if there were one: where it does not count for
  // existence, twice its own error is to be below the indentation and the openings next to it.
  bool shows(std::size_t k, std::size_t i) const;
  // Of the indentation in run k at an event, m: the median of its differences to this run.
  double own_error(std::size_t k, std::size_t event) const;
  void set_deltas();
  static double median_around(std::size_t i, std::size_t n,
                              const std::function<std::optional<double>(std::size_t)>& value);
  // The largest between a value of a sub-impact and those of its counterparts; none: it has none.
  std::optional<double> difference(std::size_t i, const Value& value) const;
  // The same of the opening after it (m), in runs in which the same one follows.
  std::optional<double> opening_difference(std::size_t i) const;
  // The error of the indentation from an event to the next, m.
  double delta(std::size_t event) const;
  // How far the indentation goes beyond the residual one, m.
  double depth(std::size_t i) const;
  // How far the gap opens after a sub-impact, m: a parabola with the rates at both ends.
  double opening(std::size_t i) const;
  double flight_end(std::size_t i) const;
  // Whether run k beside this one stopped before a time (s).
  bool stopped_before(std::size_t k, double time) const;
  // Run k shows something else, or stopped.
  Reason reason_beside(Reason::Kind kind, std::size_t k) const;
  // Error of the margin of a near miss, within a contact or flight of that length: from the
  // differences of the margin in the runs beside, or from the error of the indentation if one that
  // counts for existence lacks this near miss.
  double margin_error(const NearMiss& here, double length, double delta) const;
  // Whether errors leave open if the contacts before and after an opening count as one.
  std::optional<Reason> doubt_by_joining(std::size_t i) const;
  std::optional<Reason> doubt_by_near_miss(NearMissKind kind, std::size_t i,
                                           double strictness) const;

  const Case& input_;
  const Result& run_;
  const std::vector<SubImpact>& all_;
  std::span<const RunBeside> beside_;
  std::vector<Partners> partners_;         // one per run beside
  std::vector<std::size_t> of_existence_;  // the runs beside that show it
  std::vector<Event> events_;
  std::vector<double> deltas_;  // m, of the indentation at each event
  double runs_factor_;          // of all safety factors: single_run_factor or 1
  bool has_one_near_run_;       // and a far one: the mesh is fine
  Safety safety_;
};

}  // namespace subimpact
