#include "subimpact/study/judgement.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "numerics/median.h"
#include "numerics/units.h"
#include "study/mesh_resolution.h"
#include "study/totals.h"
#include "subimpact/study/match.h"
#include "subimpact/study/other_mesh.h"

namespace subimpact {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

// Measured on random scenes (validation/judgement).
constexpr double time_safety = 2.4;
constexpr double value_safety = 2.8;
constexpr double margin_safety = 2.5;
constexpr double existence_safety = 0.75;
// More of these where one run alone shows a part of the error; of those of existence after an
// uncertain sub-impact of the same sub-zone.
constexpr double of_one_run = 1.5;
constexpr double after_uncertain = 1.5;
constexpr double end_safety = 4.0;  // of what free ends leave
constexpr double depth_safety = 0.5;
constexpr double steepest = 1.5;  // slope of a contact law over that of the secant, at most
// Events or sub-impacts on either side whose errors count for one.
constexpr std::size_t half_window = 3;
// Near misses correspond if they are closer than this share of the contact or the flight.
constexpr double near_share = 0.25;
constexpr double rounding_of_times = 1e-14;  // relative
constexpr double loosest_rtol = 1e-2;
constexpr double alike = 0.025;  // velocities at the end, over that of the strike

// Whether runs show an error of the mesh.
bool of_mesh(std::span<const RunBeside> beside) {
  return std::ranges::any_of(beside, [](const RunBeside& other) {
    return other.of.of_rows && other.of.part.starts_with("mesh");
  });
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

// A start or an end; the error before safety.
struct Event {
  double time = 0.0;
  double rate = 0.0;  // m/s, of the indentation
  double error = 0.0;
  bool known = false;
};

// Judges a run by the runs that show one part of its error. Event 2 i is the start of sub-impact i,
// 2 i + 1 its end.
class Judge {
 public:
  Judge(const Case& input, const Result& run, std::span<const RunBeside> beside)
      : input_(input),
        run_(run),
        all_(run.sub_impacts),
        beside_(beside),
        of_runs_(beside.size() > 1 ? 1.0 : of_one_run) {
    for (const RunBeside& other : beside) {
      if (other.of.of_existence) of_existence_.push_back(partners_.size());
      partners_.push_back(partners_in(run, other.result));
    }
    set_events();
    set_deltas();
  }

  double time_error(std::size_t event) const {
    const bool is_given = !input_.scene.bodies().has_approach_to_compute();
    if (event == 0 && is_given) return 0.0;  // the first touch
    const Event& here = events_[event];
    if (!here.known) return unknown;
    const double least = here.rate > 0.0 ? deltas_[event] / here.rate : here.error;
    const double since_touch = here.time - run_.sub_impacts.front().start;
    const double of_ends =
        of_mesh(beside_) ? free_end_error(input_, run_.used.contact_time, since_touch) : 0.0;
    return std::max({time_safety * of_runs_ * std::max(here.error, least), end_safety * of_ends,
                     rounding_of_times * here.time});
  }

  // Error of a value: at least the median of the errors around it, because single differences may
  // be small by chance. `least`: the smallest error to be stated.
  double value_error(std::size_t i, double SubImpact::*value, double least = 0.0) const {
    const std::optional<double> own = difference(i, value);
    if (!own) return unknown;
    const double around =
        median_around(i, all_.size(), [&](std::size_t k) { return difference(k, value); });
    const double error = std::max(*own, around);
    return std::max(value_safety * of_runs_ * error, least);
  }

  // Errors of the largest indentation (m) and force (N) due to the error of the indentation.
  double least_indentation_error(std::size_t i) const { return depth_safety * delta(2 * i); }
  double least_force_error(std::size_t i) const {
    return least_indentation_error(i) * steepest * all_[i].peak_force / depth(i);
  }

  // Why a sub-impact is not certain; empty if it is. `strictness` multiplies errors.
  std::string doubt_of(std::size_t i, double strictness) const {
    for (const std::size_t k : of_existence_) {
      const Partner& partner = partners_[k].of[i];
      if (partner.there && partner.alone) continue;
      return (partner.there ? "it is split or merged or does not end with "
                            : "it does not exist with ") +
             beside_[k].of.description;
    }
    const SubImpact& here = all_[i];
    const auto small = [](const char* what, double length, double error, const char* unit) {
      return fmt::format("{} is {:.2g} {} with an error of {:.2g} {}", what, length, unit, error,
                         unit);
    };
    const double touch = strictness * delta(2 * i);
    if (!(touch < depth(i))) return small("its indentation", um * depth(i), um * touch, "um");
    for (const std::size_t first : {i - 1, i}) {
      if (first >= all_.size() || first + 1 >= all_.size() || !all_[first].end) continue;
      const char* what = first == i ? "the opening after it" : "the opening before it";
      const double error = strictness * delta(2 * first + 1);
      if (!(error < opening(first))) return small(what, um * opening(first), um * error, "um");
    }
    const double start_error = time_error(2 * i);
    const double end_error = here.end ? time_error(2 * i + 1) : 0.0;
    for (const LengthBeside& beside : lengths_beside(all_, i)) {
      using Kind = LengthBeside::Kind;
      const double error =
          strictness * ((beside.kind == Kind::separation_after ? 0.0 : start_error) +
                        (beside.kind == Kind::separation_before ? 0.0 : end_error));
      if (error > beside.length) {
        return small(beside.words, us * beside.length, us * error, "us");
      }
    }
    return doubt_by_near_miss(NearMissKind::opening, i, strictness);
  }

  // Why the flight after a sub-impact may hold another one; empty if it does not.
  std::string doubt_of_flight(std::size_t i) const {
    if (!all_[i].end) return {};
    for (const std::size_t k : of_existence_) {
      for (const SubImpact* extra : partners_[k].extra) {
        if (extra->start < flight_end(i) && beside_[k].result.end_of(*extra) > *all_[i].end) {
          return "there is another one with " + beside_[k].of.description;
        }
      }
    }
    return doubt_by_near_miss(NearMissKind::closing, i, 1.0);
  }

  // Error (m) of the closest approach after the last sub-impact, or in a run without sub-impacts.
  double approach_error() const {
    const auto [time, gap, error] = *run_.closest_approach;
    if (all_.empty()) {
      return margin_error({time, gap, NearMissKind::closing}, run_.outcome.time, unknown);
    }
    const std::size_t last = all_.size() - 1;
    const double length = flight_end(last) - *all_[last].end;
    return margin_error({time, gap, NearMissKind::closing}, length, delta(2 * last + 1));
  }

  // The share of the runs that have it, with one run more that does not.
  double probability(std::size_t i) const {
    const auto n = std::ranges::count_if(of_existence_, [&](std::size_t k) {
      return partners_[k].of[i].there && partners_[k].of[i].alone;
    });
    return (1.0 + static_cast<double>(n)) / (2.0 + static_cast<double>(of_existence_.size()));
  }

 private:
  void set_events() {
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
          event.error = std::max(event.error, beside_[k].of.gain * std::abs(event.time - time));
        };
        include(start, there->start);
        if (all_[i].end && there->end) include(end, *there->end);
      }
    }
  }

  // The sub-impact of a run beside that shows errors of one; none: it has none.
  const SubImpact* shown_by(std::size_t k, std::size_t i) const {
    const Partner& partner = partners_[k].of[i];
    return partner.alone || beside_[k].of.of_existence ? partner.there : nullptr;
  }

  void set_deltas() {
    const auto depth = [this](std::size_t k) -> std::optional<double> {
      if (k == 0 || !events_[k].known) return std::nullopt;
      return events_[k].error * events_[k].rate;
    };
    for (std::size_t e = 0; e < events_.size(); ++e) {
      deltas_.push_back(median_around(e, events_.size(), depth));
    }
  }

  static double median_around(std::size_t i, std::size_t n,
                              const std::function<std::optional<double>(std::size_t)>& value) {
    std::vector<double> around;
    const std::size_t end = std::min(i + half_window + 1, n);
    for (std::size_t k = std::max(i, half_window) - half_window; k < end; ++k) {
      if (const auto here = value(k)) around.push_back(*here);
    }
    return median(std::move(around));
  }

  // The largest between a value of a sub-impact and those of its counterparts; none: it has none.
  std::optional<double> difference(std::size_t i, double SubImpact::*value) const {
    std::optional<double> largest;
    for (std::size_t k = 0; k < beside_.size(); ++k) {
      const SubImpact* there = shown_by(k, i);
      if (!there) continue;
      const double here = beside_[k].of.gain * std::abs(all_[i].*value - there->*value);
      largest = std::max(largest.value_or(0.0), here);
    }
    return largest;
  }

  // The error of the indentation from an event to the next, m.
  double delta(std::size_t event) const {
    const std::size_t next = std::min(event + 1, deltas_.size() - 1);
    return existence_safety * of_runs_ * std::max(deltas_[event], deltas_[next]);
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

  // Error of the margin of a near miss, within a contact or flight of that length: from the
  // differences of the margin in the runs beside, or from the error of the indentation if one of
  // them lacks this near miss.
  double margin_error(const NearMiss& here, double length, double delta) const {
    double error = 0.0;
    for (const std::size_t k : of_existence_) {
      const RunBeside& other = beside_[k];
      const double safety = margin_safety * of_runs_;
      double distance = near_share * length, difference = delta / safety;
      const auto include = [&](double time, double margin) {
        if (std::abs(time - here.time) > distance) return;
        distance = std::abs(time - here.time);
        difference = other.of.gain * std::abs(margin - here.margin);
      };
      for (const NearMiss& there : other.result.near_misses) {
        if (there.kind == here.kind) include(there.time, there.margin);
      }
      const auto& last = other.result.closest_approach;
      if (last && here.kind == NearMissKind::closing) include(last->time, last->gap);
      error = std::max(error, safety * difference);
    }
    return error;
  }

  std::string doubt_by_near_miss(NearMissKind kind, std::size_t i, double strictness) const {
    const bool opens = kind == NearMissKind::opening;
    const double start = opens ? all_[i].start : *all_[i].end;
    const double end = opens ? run_.end_of(all_[i]) : flight_end(i);
    for (const NearMiss& here : run_.near_misses) {
      if (here.kind != kind || here.time < start || here.time > end) continue;
      const double error =
          strictness * margin_error(here, end - start, delta(opens ? 2 * i : 2 * i + 1));
      if (here.margin > error) continue;
      return fmt::format("at {:.6g} us the {}: {:.2g} um are left with an error of {:.2g} um",
                         us * here.time, opens ? "contact nearly opens" : "gap nearly closes",
                         um * here.margin, um * error);
    }
    return {};
  }

  const Case& input_;
  const Result& run_;
  const std::vector<SubImpact>& all_;
  std::span<const RunBeside> beside_;
  std::vector<Partners> partners_;         // one per run beside
  std::vector<std::size_t> of_existence_;  // the runs beside that show it
  std::vector<Event> events_;
  std::vector<double> deltas_;  // m, of the indentation at each event
  double of_runs_;              // of all safety factors
};

// --- parts ---------------------------------------------------------------------------------------

void add_error(std::optional<double>& sum, double error) { sum = sum.value_or(0.0) + error; }

// All errors of a sub-impact.
constexpr std::optional<double> SubImpact::*errors[] = {&SubImpact::start_error,
                                                        &SubImpact::end_error,
                                                        &SubImpact::error_time,
                                                        &SubImpact::error_mesh,
                                                        &SubImpact::error_layers,
                                                        &SubImpact::peak_force_error,
                                                        &SubImpact::impulse_error,
                                                        &SubImpact::max_indentation_error,
                                                        &SubImpact::residual_indentation_error,
                                                        &SubImpact::striker_velocity_error};

std::optional<double>* part_of(SubImpact& s, const std::string& name) {
  if (name == "time") return &s.error_time;
  if (name == "mesh") return &s.error_mesh;
  return name == "layers" ? &s.error_layers : nullptr;
}

void add_errors(const Judge& judge, std::size_t i, const std::string& part, SubImpact& s) {
  const double start = judge.time_error(2 * i);
  const double end = s.end ? judge.time_error(2 * i + 1) : 0.0;
  add_error(s.start_error, start);
  if (s.end) add_error(s.end_error, end);
  if (auto* error = part_of(s, part)) add_error(*error, std::max(start, end));
  add_error(s.peak_force_error,
            judge.value_error(i, &SubImpact::peak_force, judge.least_force_error(i)));
  add_error(s.impulse_error, judge.value_error(i, &SubImpact::impulse));
  add_error(s.max_indentation_error,
            judge.value_error(i, &SubImpact::max_indentation, judge.least_indentation_error(i)));
  add_error(s.residual_indentation_error, judge.value_error(i, &SubImpact::residual_indentation));
  add_error(s.striker_velocity_error, judge.value_error(i, &SubImpact::striker_velocity));
}

std::string descriptions_of(std::span<const RunBeside> beside) {
  std::vector<std::string> all;
  for (const RunBeside& run : beside) all.push_back(run.of.description);
  return fmt::format("{}", fmt::join(all, ", "));
}

// The first of the sub-impacts and flights that are not certain.
void set_first_unresolved(ErrorEstimate::Part& part, std::size_t i, const std::string& reason) {
  if (part.first_unresolved) return;
  part.first_unresolved = i;
  part.reason = reason;
}

ErrorEstimate::Part judge_part(const Case& input, Result& run, std::span<const RunBeside> beside,
                               ErrorEstimate& estimate) {
  const Judge judge(input, run, beside);
  ErrorEstimate::Part part;
  part.name = beside.front().of.part;
  part.refined_run = descriptions_of(beside);
  double strictness = 1.0;
  for (std::size_t i = 0; i < run.sub_impacts.size(); ++i) {
    SubImpact& s = run.sub_impacts[i];
    const SubImpact& before = run.sub_impacts[i > 0 ? i - 1 : 0];
    if (s.zone != before.zone || s.subzone != before.subzone) strictness = 1.0;
    add_errors(judge, i, part.name, s);
    if (const std::string doubt = judge.doubt_of(i, strictness); !doubt.empty()) {
      strictness = after_uncertain;
      s.certain = false;
      if (s.doubt.empty()) s.doubt = doubt;
      s.probability = std::min(*s.probability, judge.probability(i));
      set_first_unresolved(part, i, doubt);
    }
    if (std::string flight = judge.doubt_of_flight(i); !flight.empty()) {
      set_first_unresolved(part, i + 1, flight);
      const auto known =
          std::ranges::find(estimate.uncertain_flights, i, &ErrorEstimate::UncertainFlight::after);
      if (known == estimate.uncertain_flights.end()) {
        estimate.uncertain_flights.push_back({i, std::move(flight)});
      }
    }
  }
  if (run.closest_approach) add_error(run.closest_approach->error, judge.approach_error());
  return part;
}

// Whether it is proven for this run and for those beside it that no contact follows, and they end
// alike.
bool is_over(const Case& input, const Result& run, std::span<const RunBeside> beside) {
  const double tolerated = alike * input.scene.bodies().velocity_scale();
  return run.no_more_contact && std::ranges::all_of(beside, [&](const RunBeside& other) {
           const double difference = other.result.striker_velocity - run.striker_velocity;
           return !other.of.of_existence ||
                  (other.result.no_more_contact && std::abs(difference) < tolerated);
         });
}

// Why the mesh does not show sub-impacts, whatever runs agree on: of the first that it does not.
std::string first_mesh_doubt(const Case& input, const Result& run) {
  std::string doubt = mesh_doubt(input, run.used);
  for (std::size_t i = 0; i < run.sub_impacts.size() && doubt.empty(); ++i) {
    doubt = unresolved_contact(input, run, i);
    if (!doubt.empty()) doubt = fmt::format("sub-impact {}: {}", i + 1, doubt);
  }
  return doubt;
}

// What another mesh shows about a run whose rows do not include the error of the mesh.
ErrorEstimate::FinerMeshes finer_meshes(const Case& input, const Result& run,
                                        const RunBeside& other) {
  Result here;
  here.outcome = run.outcome;
  here.sub_impacts = run.sub_impacts;
  here.near_misses = run.near_misses;
  here.used = run.used;
  for (SubImpact& s : here.sub_impacts) {
    s.certain = true;
    s.probability = 1.0;
  }
  ErrorEstimate none;
  judge_part(input, here, {&other, 1}, none);
  const auto n_same =
      std::ranges::count(here.sub_impacts, std::optional(true), &SubImpact::certain);
  const std::vector<SubImpact>& there = other.result.sub_impacts;
  ErrorEstimate::FinerMeshes found{other.of.description, there.size(),
                                   static_cast<std::size_t>(n_same), std::nullopt,
                                   first_mesh_doubt(input, run)};
  if (!here.sub_impacts.empty() && !there.empty() && here.sub_impacts[0].end && there[0].end) {
    const double change = *there[0].end - *here.sub_impacts[0].end;
    const bool is_finer = mesh_count(other.of.input) > mesh_count(input);
    found.change_of_first_end = is_finer ? change : -other.of.gain * change;
  }
  return found;
}

// Why the steps do not show sub-impacts: runs so loose share what they miss.
std::string tolerance_doubt(const SolverOptions& solver) {
  const bool has_tolerance = !solver.step && solver.method != Method::central_difference;
  if (!has_tolerance || solver.rtol <= loosest_rtol) return {};
  return fmt::format("solver.rtol = {:.2g} is too loose for runs to show each other's errors",
                     solver.rtol);
}

// Sub-impacts that mesh or steps do not show, whatever runs agree on. `about_mesh`: runs beside
// have other meshes.
void doubt_unresolved(const Case& input, bool about_mesh, Result& run, ErrorEstimate& estimate) {
  const std::string of_steps = tolerance_doubt(input.solver);
  const std::string of_mesh = about_mesh ? mesh_doubt(input, run.used) : "";
  for (std::size_t i = 0; i < run.sub_impacts.size(); ++i) {
    SubImpact& s = run.sub_impacts[i];
    std::string doubt = of_steps.empty() ? of_mesh : of_steps;
    if (doubt.empty() && about_mesh) doubt = unresolved_contact(input, run, i);
    if (doubt.empty()) continue;
    s.certain = false;
    s.doubt = doubt;
    s.probability = std::min(*s.probability, 0.5);
    for (ErrorEstimate::Part& part : estimate.parts) {
      const bool is_meant = part.name.starts_with(of_steps.empty() ? "mesh" : "time");
      if (!is_meant || part.first_unresolved.value_or(i + 1) <= i) continue;
      part.first_unresolved = i;
      part.reason = doubt;
    }
  }
}

void set_largest_errors(Result& run, ErrorEstimate& estimate) {
  for (SubImpact& s : run.sub_impacts) {
    if (!*s.certain) continue;
    const auto include = [](double& largest, const std::optional<double>& error) {
      largest = std::max(largest, error.value_or(0.0));
    };
    include(estimate.largest_error, s.start_error);
    include(estimate.largest_error, s.end_error);
    for (ErrorEstimate::Part& part : estimate.parts) {
      const auto* error = part_of(s, part.name);
      include(part.largest_error, error ? *error : s.start_error);
      if (!error) include(part.largest_error, s.end_error);
    }
  }
}

void find_first_unresolved(const Result& run, ErrorEstimate& estimate) {
  for (std::size_t i = 0; i < run.sub_impacts.size() && !estimate.first_unresolved; ++i) {
    if (!*run.sub_impacts[i].certain) {
      estimate.first_unresolved = i;
      estimate.reason = run.sub_impacts[i].doubt;
      return;
    }
    const auto flight =
        std::ranges::find(estimate.uncertain_flights, i, &ErrorEstimate::UncertainFlight::after);
    if (flight == estimate.uncertain_flights.end()) continue;
    estimate.first_unresolved = i + 1;
    estimate.reason = flight->reason;
  }
}

}  // namespace

void judge(const Case& input, Result& run, std::span<const RunBeside> beside) {
  if (beside.empty()) return;
  ErrorEstimate estimate;
  estimate.refined_run = descriptions_of(beside);
  for (SubImpact& s : run.sub_impacts) {
    s.certain = true;
    s.probability = 1.0;
    for (const auto error : errors) (s.*error).reset();
  }
  if (run.closest_approach) run.closest_approach->error.reset();
  for (auto first = beside.begin(); first != beside.end();) {
    const auto last = std::find_if(first, beside.end(), [&](const RunBeside& other) {
      return other.of.part != first->of.part;
    });
    if (!first->of.of_rows) {
      estimate.finer_meshes = finer_meshes(input, run, *first);
    } else {
      estimate.parts.push_back(judge_part(input, run, {first, last}, estimate));
      if (first->of.part == "mesh") set_mesh_limits(input, run, {first, last});
    }
    first = last;
  }
  for (SubImpact& s : run.sub_impacts) {
    for (const auto error : errors) {
      if (s.*error && !std::isfinite(*(s.*error))) (s.*error).reset();
    }
  }
  doubt_unresolved(input, of_mesh(beside), run, estimate);
  run.contact_over = is_over(input, run, beside);
  find_first_unresolved(run, estimate);
  set_largest_errors(run, estimate);
  set_totals(input, run, beside, estimate);
  run.error_estimate = std::move(estimate);
}

}  // namespace subimpact
