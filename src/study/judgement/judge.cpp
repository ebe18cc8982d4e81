#include "study/judgement/judge.h"

#include <algorithm>
#include <cmath>

#include "numerics/estimates.h"
#include "study/judgement/mesh_resolution.h"
#include "subimpact/study/judgement/event_errors.h"

namespace subimpact {
namespace {

// Safety factors, measured on random scenes: the tables of validation/truth/judgement.
constexpr Judge::Safety of_near_runs{2.4, 2.8, 0.75}, of_near_and_far_run{2.7, 3.2, 0.8};
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

using Kind = Reason::Kind;

// The near misses from one time to another, s.
auto between(const std::vector<NearMiss>& all, double from, double to) {
  return std::ranges::subrange(std::ranges::lower_bound(all, from, {}, &NearMiss::time),
                               std::ranges::upper_bound(all, to, {}, &NearMiss::time));
}

}  // namespace

bool of_mesh(std::span<const RunBeside> beside) {
  return std::ranges::any_of(beside, [](const RunBeside& other) {
    return other.of.of_rows && other.of.source != ErrorSource::time;
  });
}

Judge::Partners Judge::partners_in(const Result& run, const Result& other) {
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

Judge::Judge(const Case& input, const Result& run, std::span<const RunBeside> beside)
    : input_(input),
      run_(run),
      all_(run.sub_impacts),
      beside_(beside),
      runs_factor_(beside.size() > 1 ? 1.0 : single_run_factor),
      has_one_near_run_(beside.size() == 2 && std::ranges::count_if(beside,
                                                                    [](const RunBeside& other) {
                                                                      return other.of.of_existence;
                                                                    }) == 1),
      safety_(has_one_near_run_ ? of_near_and_far_run : of_near_runs) {
  for (const RunBeside& other : beside) {
    if (other.of.of_existence) of_existence_.push_back(partners_.size());
    partners_.push_back(partners_in(run, other.result));
  }
  set_events();
  set_deltas();
}

double Judge::time_error(std::size_t event) const {
  const bool is_given = !input_.scene.bodies().has_approach_to_compute();
  if (event == 0 && is_given) return 0.0;  // the first touch
  const Event& here = events_[event];
  if (!here.known) return unknown;
  const double least = here.rate > 0.0 ? deltas_[event] / here.rate : here.error;
  const double since_touch = here.time - run_.sub_impacts.front().start;
  const double of_ends =
      of_mesh(beside_) ? free_end_error(input_, run_.used.contact_time, since_touch) : 0.0;
  return std::max({safety_.time * runs_factor_ * std::max(here.error, least),
                   free_end_safety * of_ends, rounding_of_times * here.time});
}

double Judge::usual_time_error(std::size_t event) const {
  if (!has_one_near_run_) return time_error(event);
  const double around =
      median_around(event, events_.size(), [&](std::size_t e) -> std::optional<double> {
        return e > 0 && events_[e].known ? std::optional(time_error(e)) : std::nullopt;
      });
  return std::min(time_error(event), most_over_median * around);
}

double Judge::value_error(std::size_t i, const Value& value, double least) const {
  const std::optional<double> own = difference(i, value);
  if (!own) return unknown;
  const double around =
      median_around(i, all_.size(), [&](std::size_t k) { return difference(k, value); });
  const double error = std::max(*own, around);
  return std::max(safety_.value * runs_factor_ * error, least);
}

double Judge::opening_error(std::size_t i) const {
  const std::optional<double> own = opening_difference(i);
  if (!own) return unknown;
  const double around = median_around(i, all_.size(), [&](std::size_t k) {
    const std::optional<double> there = opening_difference(k);
    const bool is_known = there && *all_[k].opening > 0.0;
    return is_known ? std::optional(*there * *all_[i].opening / *all_[k].opening) : std::nullopt;
  });
  return std::max(safety_.value * runs_factor_ * std::max(*own, around), delta(2 * i + 1));
}

double Judge::least_indentation_error(std::size_t i) const { return depth_safety * delta(2 * i); }

double Judge::least_force_error(std::size_t i) const {
  return least_indentation_error(i) * steepest * all_[i].peak_force / depth(i);
}

std::optional<Reason> Judge::doubt_of(std::size_t i, double strictness) const {
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
    const double error = strictness * ((beside.kind == Kind::separation_after ? 0.0 : start_error) +
                                       (beside.kind == Kind::separation_before ? 0.0 : end_error));
    if (error > beside.length) return Reason{beside.kind, {}, beside.length, error};
  }
  return doubt_by_near_miss(NearMissKind::opening, i, strictness);
}

std::optional<Reason> Judge::doubt_of_flight(std::size_t i) const {
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

bool Judge::stopped_before(std::size_t k, double time) const {
  const Outcome& until = beside_[k].result.outcome;
  return !until.completed() && until.time <= time;
}

Reason Judge::reason_beside(Kind kind, std::size_t k) const {
  const auto& [of, result] = beside_[k];
  return {.kind = kind, .what = of.description, .time = result.outcome.time};
}

double Judge::approach_error() const {
  const auto [time, gap, error] = *run_.closest_approach;
  if (all_.empty()) {
    return margin_error({time, gap, NearMissKind::closing}, run_.outcome.time, unknown);
  }
  const std::size_t last = all_.size() - 1;
  const double length = flight_end(last) - *all_[last].end;
  return margin_error({time, gap, NearMissKind::closing}, length, delta(2 * last + 1));
}

double Judge::probability(std::size_t i) const {
  double n = 0.0, n_with = 0.0;
  for (const std::size_t k : of_existence_) {
    if (stopped_before(k, run_.end_of(all_[i]))) continue;
    n += 1.0;
    if (partners_[k].of[i].there && partners_[k].of[i].alone) n_with += 1.0;
  }
  return (1.0 + n_with) / (2.0 + n);
}

void Judge::set_events() {
  events_.resize(2 * all_.size());
  for (std::size_t i = 0; i < all_.size(); ++i) {
    Event& start = events_[2 * i];
    Event& end = events_[2 * i + 1];
    start.time = all_[i].start;
    start.rate = std::abs(all_[i].start_rate);
    end.time = run_.end_of(all_[i]);
    end.rate = std::abs(all_[i].end_rate);
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
}

const SubImpact* Judge::shown_by(std::size_t k, std::size_t i) const {
  const Partner& partner = partners_[k].of[i];
  if (stopped_before(k, run_.end_of(all_[i]))) return nullptr;
  return partner.alone || beside_[k].of.of_existence ? partner.there : nullptr;
}

double Judge::gain(std::size_t k, std::size_t i) const {
  const double full = beside_[k].of.gain;
  if (!has_one_near_run_) return full;
  for (std::size_t far = 0; far < beside_.size(); ++far) {
    const bool is_far = !beside_[far].of.of_existence;
    if (is_far && shown_by(far, i)) return std::min(full, most_gain_beside_far);
  }
  return full;
}

bool Judge::shows(std::size_t k, std::size_t i) const {
  if (beside_[k].of.of_existence) return true;
  const double error = own_error_factor * std::max(own_error(k, 2 * i), own_error(k, 2 * i + 1));
  return error < depth(i) && (i == 0 || error < opening(i - 1)) &&
         (i + 1 == all_.size() || error < opening(i));
}

double Judge::own_error(std::size_t k, std::size_t event) const {
  return median_around(event, events_.size(), [&](std::size_t e) -> std::optional<double> {
    const SubImpact* there = shown_by(k, e / 2);
    if (there == nullptr) return unknown;
    const std::optional<double> time = e % 2 == 0 ? std::optional(there->start) : there->end;
    return time ? std::abs(events_[e].time - *time) * events_[e].rate : unknown;
  });
}

void Judge::set_deltas() {
  const auto depth = [this](std::size_t k) -> std::optional<double> {
    if (k == 0 || !events_[k].known) return std::nullopt;
    return events_[k].error * events_[k].rate;
  };
  for (std::size_t e = 0; e < events_.size(); ++e) {
    deltas_.push_back(median_around(e, events_.size(), depth));
  }
}

double Judge::median_around(std::size_t i, std::size_t n,
                            const std::function<std::optional<double>(std::size_t)>& value) {
  std::vector<double> around;
  const std::size_t end = std::min(i + half_window + 1, n);
  for (std::size_t k = std::max(i, half_window) - half_window; k < end; ++k) {
    if (const auto here = value(k)) around.push_back(*here);
  }
  return median(std::move(around));
}

std::optional<double> Judge::difference(std::size_t i, const Value& value) const {
  std::optional<double> largest;
  const std::optional<double> of_run = value(all_[i]);
  for (std::size_t k = 0; k < beside_.size(); ++k) {
    const SubImpact* there = shown_by(k, i);
    const std::optional<double> of_other = there ? value(*there) : std::nullopt;
    if (!of_run || !of_other) continue;
    const double here = gain(k, i) * std::abs(*of_run - *of_other);
    largest = std::max(largest.value_or(0.0), here);
  }
  return largest;
}

std::optional<double> Judge::opening_difference(std::size_t i) const {
  std::optional<double> largest;
  for (std::size_t k = 0; k < beside_.size() && all_[i].opening; ++k) {
    const SubImpact* there = shown_by(k, i);
    if (!there || !there->opening) continue;
    const bool is_last = there == &beside_[k].result.sub_impacts.back();
    const SubImpact* next = i + 1 < all_.size() ? partners_[k].of[i + 1].there : nullptr;
    if (next != (is_last ? nullptr : there + 1)) continue;
    const double here = gain(k, i) * std::abs(*all_[i].opening - *there->opening);
    largest = std::max(largest.value_or(0.0), here);
  }
  return largest;
}

double Judge::delta(std::size_t event) const {
  const std::size_t next = std::min(event + 1, deltas_.size() - 1);
  return safety_.existence * runs_factor_ * std::max(deltas_[event], deltas_[next]);
}

double Judge::depth(std::size_t i) const {
  return all_[i].max_indentation - (i > 0 ? all_[i - 1].residual_indentation : 0.0);
}

double Judge::opening(std::size_t i) const {
  const double length = all_[i + 1].start - *all_[i].end;
  return 0.125 * length * (events_[2 * i + 1].rate + events_[2 * i + 2].rate);
}

double Judge::flight_end(std::size_t i) const {
  return i + 1 < all_.size() ? all_[i + 1].start : run_.outcome.time;
}

double Judge::margin_error(const NearMiss& here, double length, double delta) const {
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

std::optional<Reason> Judge::doubt_by_joining(std::size_t i) const {
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

std::optional<Reason> Judge::doubt_by_near_miss(NearMissKind kind, std::size_t i,
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

}  // namespace subimpact
