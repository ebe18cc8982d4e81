#include "study/judgement/judge.h"

#include <functional>
#include <utility>

#include "numerics/estimates.h"
#include "study/judgement/mesh_resolution.h"
#include "subimpact/study/judgement/event_errors.h"

namespace subimpact {
namespace {

// Safety factors, measured on random scenes: the tables of validation/truth/judgement.
struct Safety {
  double time, value, existence;  // the last of the indentation, where it tells existence
};
constexpr Safety of_near_runs{2.4, 2.8, 0.75}, of_near_and_far_run{2.7, 3.2, 0.8};
constexpr double margin_safety = 2.5;
// Of a difference, where a far run shows the sub-impact too: the rest is chance.
constexpr double most_gain_beside_far = 1.4;
constexpr double most_over_median = 2.0;  // of the error of a time that makes a length uncertain
constexpr double free_end_safety = 4.0;   // safety factor of the error left by free ends
constexpr double depth_safety = 0.5;
constexpr double own_error_factor = 2.0;
constexpr double steepest = 1.5;  // slope of a contact law over that of the secant, at most
// Events or sub-impacts on either side whose errors count for one.
constexpr std::size_t half_window = 3;
// Near misses correspond if they are closer than this share of the contact or the flight.
constexpr double near_share = 0.25;
constexpr double rounding_of_times = 1e-14;  // relative
// Multiplies the errors of existence after an uncertain sub-impact of the same sub-zone, and after
// a contact with a support that another mesh lacks.
constexpr double after_uncertain = 1.5;
constexpr double unknown = HUGE_VAL;  // of an error

using Kind = Reason::Kind;
using Number = std::optional<double>;
using Value = std::function<Number(const SubImpact&)>;

// The near misses from one time to another, s.
auto between(const std::vector<NearMiss>& all, double from, double to) {
  return std::ranges::subrange(std::ranges::lower_bound(all, from, {}, &NearMiss::time),
                               std::ranges::upper_bound(all, to, {}, &NearMiss::time));
}

Number if_known(bool is_known, double value) { return is_known ? Number(value) : std::nullopt; }

// The median of what is known within the window around one of `n`.
double median_around(std::size_t i, std::size_t n, const auto& value) {
  std::vector<double> around;
  const std::size_t end = std::min(i + half_window + 1, n);
  for (std::size_t k = std::max(i, half_window) - half_window; k < end; ++k) {
    if (const Number here = value(k)) around.push_back(*here);
  }
  return median(std::move(around));
}

struct Partner {
  const SubImpact* there = nullptr;  // none: it has no counterpart
  bool alone = true;  // no other one overlaps either of the two, and both end or neither does
};

// The counterparts of the sub-impacts of a run in another one, and those that have none here.
struct Partners {
  std::vector<Partner> of;
  std::vector<const SubImpact*> extra;
};

Partners partners_in(const Result& run, const Result& other) {
  const Counterparts whole = counterparts(run.sub_impacts, other.sub_impacts);
  Partners found;
  found.of.resize(run.sub_impacts.size());
  for (const MatchedPair& pair : match_sub_impacts(run.sub_impacts, other.sub_impacts)) {
    if (!pair.second) continue;
    const SubImpact& there = other.sub_impacts[*pair.second];
    if (!pair.first) {
      found.extra.push_back(&there);
      continue;
    }
    const bool both_end = run.sub_impacts[*pair.first].end.has_value() == there.end.has_value();
    found.of[*pair.first] = {&there, whole.of[*pair.first] && both_end};
  }
  return found;
}

// Event 2 i is the start of sub-impact i, 2 i + 1 its end.
class Judge {
 public:
  Judge(const Case& input, const Result& run, std::span<const RunBeside> beside)
      : input_(input), run_(run), beside_(beside) {
    for (const RunBeside& other : beside) {
      if (other.of.of_existence) of_existence_.push_back(partners_.size());
      partners_.push_back(partners_in(run, other.result));
    }
    has_one_near_run_ = beside.size() == 2 && of_existence_.size() == 1;
    safety_ = has_one_near_run_ ? of_near_and_far_run : of_near_runs;
    set_events();
  }

  void set_errors(std::size_t i, SubImpact& s) const {
    const double least = depth_safety * delta(2 * i);  // of the indentation
    const auto set = [](Number& to, bool is_there, double error) {
      to = if_known(is_there && std::isfinite(error), error);
    };
    set(s.start_error, true, time_error(2 * i));
    set(s.end_error, s.end.has_value(), time_error(2 * i + 1));
    set(s.peak_force_error, true,
        value_error(i, &SubImpact::peak_force, least * steepest * s.peak_force / depth(i)));
    set(s.impulse_error, true, value_error(i, &SubImpact::impulse));
    set(s.max_indentation_error, true, value_error(i, &SubImpact::max_indentation, least));
    set(s.residual_indentation_error, true, value_error(i, &SubImpact::residual_indentation));
    set(s.striker_velocity_error, true, value_error(i, &SubImpact::striker_velocity));
    set(s.opening_error, s.opening.has_value(), opening_error(i));
  }

  // Why a sub-impact is not certain; none if it is. `strictness` multiplies errors.
  std::optional<Reason> doubt_of(std::size_t i, double strictness) const {
    for (std::size_t k = 0; k < beside_.size(); ++k) {
      const Partner& partner = partners_[k].of[i];
      if ((partner.there && partner.alone) || !shows(k, i)) continue;
      if (stopped_before(k, run_.end_of(all_[i]))) return reason_beside(Kind::stopped_beside, k);
      return reason_beside(partner.there ? Kind::split_beside : Kind::missing_beside, k);
    }
    const SubImpact& here = all_[i];
    const double touch = strictness * delta(2 * i);
    if (!(touch < depth(i))) return Reason{Kind::indentation, {}, depth(i), touch};
    for (const std::size_t first : {i - 1, i}) {
      if (first >= all_.size() || first + 1 >= all_.size() || !all_[first].end) continue;
      const double error = strictness * delta(2 * first + 1);
      if (error < opening(first)) continue;
      return Reason{
          first == i ? Kind::opening_after : Kind::opening_before, {}, opening(first), error};
    }
    if (auto joined = doubt_by_joining(i)) return joined;
    const double start_error = usual_time_error(2 * i);
    const double end_error = here.end ? usual_time_error(2 * i + 1) : 0.0;
    for (const LengthBeside& beside : lengths_beside(all_, i)) {
      const double error =
          strictness * ((beside.kind == Kind::separation_after ? 0.0 : start_error) +
                        (beside.kind == Kind::separation_before ? 0.0 : end_error));
      if (error > beside.length) return Reason{beside.kind, {}, beside.length, error};
    }
    return doubt_by_near_miss(NearMissKind::opening, i, strictness);
  }

  // Why the flight after a sub-impact may hold another one; none if it does not.
  std::optional<Reason> doubt_of_flight(std::size_t i) const {
    if (!all_[i].end) return {};
    for (const std::size_t k : of_existence_) {
      const auto extra = std::ranges::partition_point(partners_[k].extra, [&](const SubImpact* s) {
        return beside_[k].result.end_of(*s) <= *all_[i].end;
      });
      if (extra != partners_[k].extra.end() && (*extra)->start < flight_end(i)) {
        return reason_beside(Kind::another_beside, k);
      }
      if (stopped_before(k, flight_end(i))) return reason_beside(Kind::stopped_beside, k);
    }
    return doubt_by_near_miss(NearMissKind::closing, i, 1.0);
  }

  // Error (m) of the closest approach after the last sub-impact, or in a run without sub-impacts.
  double approach_error() const {
    const auto [time, gap, error] = *run_.closest_approach;
    const NearMiss approach{time, gap, NearMissKind::closing};
    if (all_.empty()) return margin_error(approach, run_.outcome.time, unknown);
    const std::size_t last = all_.size() - 1;
    return margin_error(approach, flight_end(last) - *all_[last].end, delta(2 * last + 1));
  }

  // The share of the runs that have it, with one run more that does not.
  double probability(std::size_t i) const {
    double n = 0.0, n_with = 0.0;
    for (const std::size_t k : of_existence_) {
      if (stopped_before(k, run_.end_of(all_[i]))) continue;
      n += 1.0;
      if (partners_[k].of[i].there && partners_[k].of[i].alone) n_with += 1.0;
    }
    return (1.0 + n_with) / (2.0 + n);
  }

 private:
  // A start or an end; the error before safety.
  struct Event {
    double time = 0.0;
    double rate = 0.0;  // m/s, of the indentation
    double error = 0.0;
    bool known = false;
  };

  void set_events() {
    events_.resize(2 * all_.size());
    for (std::size_t i = 0; i < all_.size(); ++i) {
      Event& start = events_[2 * i];
      Event& end = events_[2 * i + 1];
      start = {all_[i].start, std::abs(all_[i].start_rate)};
      end = {run_.end_of(all_[i]), std::abs(all_[i].end_rate)};
      for (std::size_t k = 0; k < beside_.size(); ++k) {
        const SubImpact* there = shown_by(k, i);
        if (!there) continue;
        const auto include = [&](Event& event, double time) {
          event.known = true;
          event.error = std::max(event.error, gain(k, i) * std::abs(event.time - time));
        };
        include(start, there->start);
        if (all_[i].end && there->end) include(end, *there->end);
      }
    }
    for (std::size_t e = 0; e < events_.size(); ++e) {
      deltas_.push_back(median_around(e, events_.size(), [this](std::size_t k) {
        return if_known(k > 0 && events_[k].known, events_[k].error * events_[k].rate);
      }));
    }
  }

  // Error (s) of the time of an event.
  double time_error(std::size_t event) const {
    // The first touch is given.
    if (event == 0 && !input_.scene.bodies().has_approach_to_compute()) return 0.0;
    const Event& here = events_[event];
    if (!here.known) return unknown;
    const double least = here.rate > 0.0 ? deltas_[event] / here.rate : here.error;
    const double since_touch = here.time - all_.front().start;
    const double of_ends =
        of_mesh(beside_) ? free_end_error(input_, run_.used.contact_time, since_touch) : 0.0;
    return std::max({safety_.time * runs_factor_ * std::max(here.error, least),
                     free_end_safety * of_ends, rounding_of_times * here.time});
  }

  // Where the mesh is fine, at most twice the median of those around it: a graze is known by its
  // depth, not by its time.
  double usual_time_error(std::size_t event) const {
    if (!has_one_near_run_) return time_error(event);
    const double around = median_around(event, events_.size(), [&](std::size_t e) {
      return if_known(e > 0 && events_[e].known, time_error(e));
    });
    return std::min(time_error(event), most_over_median * around);
  }

  // Error of a value: at least the median of the errors around it, because single differences may
  // be small by chance. `least`: the smallest error to be stated.
  double value_error(std::size_t i, const Value& value, double least = 0.0) const {
    const Number own = difference(i, value);
    if (!own) return unknown;
    const double around =
        median_around(i, all_.size(), [&](std::size_t k) { return difference(k, value); });
    return std::max(safety_.value * runs_factor_ * std::max(*own, around), least);
  }

  // Error (m) of the opening after a sub-impact: at least the median of the relative errors around
  // it, because openings of all sizes follow each other, and the error of the indentation.
  double opening_error(std::size_t i) const {
    const Number own = difference(i, &SubImpact::opening, true);
    if (!own) return unknown;
    const double around = median_around(i, all_.size(), [&](std::size_t k) {
      const Number there = difference(k, &SubImpact::opening, true);
      return there && *all_[k].opening > 0.0 ? Number(*there * *all_[i].opening / *all_[k].opening)
                                             : std::nullopt;
    });
    return std::max(safety_.value * runs_factor_ * std::max(*own, around), delta(2 * i + 1));
  }

  // The sub-impact of a run beside that shows errors of one; none: it has none.
  const SubImpact* shown_by(std::size_t k, std::size_t i) const {
    const Partner& partner = partners_[k].of[i];
    if (stopped_before(k, run_.end_of(all_[i]))) return nullptr;
    return partner.alone || beside_[k].of.of_existence ? partner.there : nullptr;
  }

  // Of a difference of that sub-impact to a run beside: more is error where no far run has it.
  double gain(std::size_t k, std::size_t i) const {
    const double full = beside_[k].of.gain;
    if (!has_one_near_run_) return full;
    const std::size_t far = 1 - of_existence_.front();
    return shown_by(far, i) ? std::min(full, most_gain_beside_far) : full;
  }

  // Whether a run beside would have sub-impact i if there were one: where it does not count for
  // existence, twice its own error is to be below the indentation and the openings next to it.
  bool shows(std::size_t k, std::size_t i) const {
    if (beside_[k].of.of_existence) return true;
    const double error = own_error_factor * std::max(own_error(k, 2 * i), own_error(k, 2 * i + 1));
    return error < depth(i) && (i == 0 || error < opening(i - 1)) &&
           (i + 1 == all_.size() || error < opening(i));
  }

  // Of the indentation in run k at an event, m: the median of its differences to this run.
  double own_error(std::size_t k, std::size_t event) const {
    return median_around(event, events_.size(), [&](std::size_t e) -> Number {
      const SubImpact* there = shown_by(k, e / 2);
      if (there == nullptr) return unknown;
      const Number time = e % 2 == 0 ? Number(there->start) : there->end;
      return time ? std::abs(events_[e].time - *time) * events_[e].rate : unknown;
    });
  }

  // The largest between a value of a sub-impact and those of its counterparts; none: it has none.
  // `followed_alike`: in runs in which the same one follows, or none does.
  Number difference(std::size_t i, const Value& value, bool followed_alike = false) const {
    Number largest;
    const Number of_run = value(all_[i]);
    for (std::size_t k = 0; k < beside_.size(); ++k) {
      const SubImpact* there = shown_by(k, i);
      const Number of_other = there ? value(*there) : std::nullopt;
      if (!of_run || !of_other) continue;
      const bool is_last = there == &beside_[k].result.sub_impacts.back();
      const SubImpact* next = i + 1 < all_.size() ? partners_[k].of[i + 1].there : nullptr;
      if (followed_alike && next != (is_last ? nullptr : there + 1)) continue;
      largest = std::max(largest.value_or(0.0), gain(k, i) * std::abs(*of_run - *of_other));
    }
    return largest;
  }

  // The error of the indentation from an event to the next, m.
  double delta(std::size_t event) const {
    const std::size_t next = std::min(event + 1, deltas_.size() - 1);
    return safety_.existence * runs_factor_ * std::max(deltas_[event], deltas_[next]);
  }

  // How far the indentation goes beyond the residual one, m.
  double depth(std::size_t i) const {
    return all_[i].max_indentation - (i > 0 ? all_[i - 1].residual_indentation : 0.0);
  }

  // How far the gap opens after a sub-impact, m: a parabola with the rates at both ends.
  double opening(std::size_t i) const {
    const double length = all_[i + 1].start - *all_[i].end;
    return 0.125 * length * (events_[2 * i + 1].rate + events_[2 * i + 2].rate);
  }

  double flight_end(std::size_t i) const {
    return i + 1 < all_.size() ? all_[i + 1].start : run_.outcome.time;
  }

  // Whether run k beside this one stopped before a time (s).
  bool stopped_before(std::size_t k, double time) const {
    const Outcome& until = beside_[k].result.outcome;
    return !until.completed() && until.time <= time;
  }

  // Run k shows something else, or stopped.
  Reason reason_beside(Kind kind, std::size_t k) const {
    const auto& [of, result] = beside_[k];
    return {.kind = kind, .what = of.description, .time = result.outcome.time};
  }

  // Error of the margin of a near miss, within a contact or flight of that length: from the
  // differences of the margin in the runs beside, or from the error of the indentation if one that
  // counts for existence lacks this near miss.
  double margin_error(const NearMiss& here, double length, double delta) const {
    double error = 0.0;
    const double safety = margin_safety * runs_factor_;
    for (const RunBeside& other : beside_) {
      double distance = near_share * length;
      double difference = other.of.of_existence ? delta / safety : 0.0;
      const auto include = [&](double time, double margin) {
        if (std::abs(time - here.time) > distance) return;
        distance = std::abs(time - here.time);
        difference = other.of.gain * std::abs(margin - here.margin);
      };
      for (const NearMiss& there :
           between(other.result.near_misses, here.time - distance, here.time + distance)) {
        if (there.kind == here.kind) include(there.time, there.margin);
      }
      const auto& last = other.result.closest_approach;
      if (last && here.kind == NearMissKind::closing) include(last->time, last->gap);
      error = std::max(error, safety * difference);
    }
    return error;
  }

  // Whether errors leave open if the contacts before and after an opening count as one.
  std::optional<Reason> doubt_by_joining(std::size_t i) const {
    const double limit = input_.output.opening;
    if (!(limit > 0.0)) return {};
    for (const std::size_t first : {i - 1, i}) {
      if (first >= all_.size() || first + 1 >= all_.size()) continue;
      const double error = opening_error(first);
      // Not known where other contacts follow in all runs: then the flight is doubted.
      if (!(error < unknown) || *all_[first].opening - error >= limit) continue;
      const Kind kind = first == i ? Kind::joined_after : Kind::joined_before;
      return Reason{kind, {}, *all_[first].opening, error, limit};
    }
    const Value inner = [](const SubImpact& s) { return s.inner_opening.value_or(0.0); };
    const double error = safety_.value * runs_factor_ * difference(i, inner).value_or(0.0);
    if (*inner(all_[i]) + error < limit) return {};
    return Reason{Kind::joined_within, {}, *inner(all_[i]), error, limit};
  }

  std::optional<Reason> doubt_by_near_miss(NearMissKind kind, std::size_t i,
                                           double strictness) const {
    const bool opens = kind == NearMissKind::opening;
    const double start = opens ? all_[i].start : *all_[i].end;
    const double end = opens ? run_.end_of(all_[i]) : flight_end(i);
    for (const NearMiss& here : between(run_.near_misses, start, end)) {
      if (here.kind != kind) continue;
      const double error =
          strictness * margin_error(here, end - start, delta(opens ? 2 * i : 2 * i + 1));
      // A contact that opens by less than the limit stays one.
      if (here.margin > error - (opens ? input_.output.opening : 0.0)) continue;
      const Kind found = opens ? Kind::nearly_opens : Kind::nearly_closes;
      return Reason{found, {}, here.margin, error, 0.0, here.time};
    }
    return {};
  }

  const Case& input_;
  const Result& run_;
  const std::vector<SubImpact>& all_ = run_.sub_impacts;
  std::span<const RunBeside> beside_;
  std::vector<Partners> partners_;         // one per run beside
  std::vector<std::size_t> of_existence_;  // the runs beside that show it
  std::vector<Event> events_;
  std::vector<double> deltas_;  // m, of the indentation at each event
  double runs_factor_ = beside_.size() > 1 ? 1.0 : single_run_factor;  // of all safety factors
  bool has_one_near_run_ = false;  // and a far one: the mesh is fine
  Safety safety_ = of_near_runs;
};

}  // namespace

void judge_rows(const Case& input, Result& run, std::span<const RunBeside> beside,
                ErrorEstimate& estimate, double support_lost) {
  const Judge judge(input, run, beside);
  double strictness = 1.0;
  for (std::size_t i = 0; i < run.sub_impacts.size(); ++i) {
    SubImpact& s = run.sub_impacts[i];
    s.certain = true;
    s.probability = 1.0;
    const SubImpact& before = run.sub_impacts[i > 0 ? i - 1 : 0];
    if (s.zone != before.zone || s.subzone != before.subzone) strictness = 1.0;
    if (s.start > support_lost) strictness = after_uncertain;
    judge.set_errors(i, s);
    if (const auto doubt = judge.doubt_of(i, strictness)) {
      strictness = after_uncertain;
      s.certain = false;
      s.doubt = doubt;
      s.probability = judge.probability(i);
    }
    if (const auto flight = judge.doubt_of_flight(i)) {
      estimate.uncertain_flights.push_back({i, *flight});
    }
  }
  if (run.closest_approach) run.closest_approach->error = judge.approach_error();
}

}  // namespace subimpact
