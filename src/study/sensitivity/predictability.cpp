#include "subimpact/study/sensitivity/predictability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/shifted_case.h"
#include "numerics/units.h"
#include "subimpact/study/judgement/match.h"

namespace subimpact {
namespace {

constexpr double share_of_length = 0.5;   // of a duration or separation, in events beside it
constexpr double share_of_change = 0.25;  // of a duration or separation, in itself
constexpr double deviations = 2.0;        // within which a graze is possible

using ByKey = std::vector<std::optional<Derivative>>;

ByKey difference(const ByKey& a, const ByKey& b) {
  ByKey result(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k] && b[k]) result[k] = {a[k]->value - b[k]->value, a[k]->error + b[k]->error};
  }
  return result;
}

class Deviations {
 public:
  Deviations(const Sensitivity& study, const Scatter& scatter) : study_(study), scatter_(scatter) {}

  const ByKey* derivatives(EventQuantity quantity, std::size_t i) const {
    const SensitivityRow* row = study_.find(quantity, i);
    return row != nullptr ? &row->by_key : nullptr;
  }
  std::optional<double> of(const ByKey& by_key) const {
    return deviation_of(by_key, study_.keys, scatter_);
  }
  std::optional<double> of(EventQuantity quantity, std::size_t i) const {
    const ByKey* by_key = derivatives(quantity, i);
    return by_key != nullptr ? of(*by_key) : std::nullopt;
  }
  std::optional<double> of_difference(EventQuantity later, std::size_t i, EventQuantity earlier,
                                      std::size_t j) const {
    const ByKey* a = derivatives(later, i);
    const ByKey* b = derivatives(earlier, j);
    return a != nullptr && b != nullptr ? of(difference(*a, *b)) : std::nullopt;
  }
  const Sensitivity& study() const { return study_; }

 private:
  const Sensitivity& study_;
  const Scatter& scatter_;
};

// The standard deviation of a number that is confined to a range is at most half of that range.
// Where derivatives give more, they do not hold over the scatter, and the deviation is not known.
std::optional<double> within_range(const std::optional<double>& deviation, double range) {
  return deviation && *deviation <= 0.5 * range ? deviation : std::nullopt;
}

// "its start scatters by 12 us, more than half of its duration, 20 us"; empty if it does not.
std::string excess(const char* what, const std::optional<double>& deviation, double share,
                   const char* of, double length) {
  if (deviation && *deviation <= share * length) return {};
  if (!deviation) return fmt::format("the standard deviation of {} is not known", what);
  return fmt::format("{} scatters by {:.2g} us, more than {} of {}, {:.2g} us", what,
                     us * *deviation, share == 0.5 ? "half" : "a quarter", of, us * length);
}

// Why a sub-impact cannot be predicted; empty if it can.
std::string unpredictable_reason(const Deviations& deviation, std::size_t i) {
  const std::vector<SubImpact>& all = deviation.study().base.sub_impacts;
  const SubImpact& here = all[i];
  std::string reason;
  const auto consider = [&](const std::string& words) {
    if (reason.empty()) reason = words;
  };
  const SensitivityRow* row = deviation.study().find(EventQuantity::start, i);
  const auto start = deviation.of(EventQuantity::start, i);
  const auto end = here.end ? deviation.of(EventQuantity::end, i) : start;
  if (!start || !end) {
    return row != nullptr && !row->flag.empty() ? "it " + row->flag
                                                : "its standard deviation is not known";
  }
  const double largest = std::max(*start, *end);
  for (const LengthBeside& beside : lengths_beside(all, i)) {
    consider(excess("its start or end", largest, share_of_length, beside.words, beside.length));
    if (beside.kind == Reason::Kind::separation_after) continue;
    const auto change =
        beside.kind == Reason::Kind::duration
            ? deviation.of_difference(EventQuantity::end, i, EventQuantity::start, i)
            : deviation.of_difference(EventQuantity::start, i, EventQuantity::end, i - 1);
    consider(excess(beside.words, change, share_of_change, "itself", beside.length));
  }
  const auto peak = here.end ? deviation.of(EventQuantity::peak_force, i) : std::optional(0.0);
  if (peak && deviations * *peak > here.peak_force) {
    consider(fmt::format("its peak force, {:.3g} N, scatters by {:.2g} N, and it may vanish",
                         here.peak_force, *peak));
  }
  return reason;
}

struct Limit {
  std::size_t first;  // sub-impact that cannot be predicted
  std::string reason;
};

// The first sub-impact that a near miss within its scatter makes uncertain.
std::optional<Limit> limit_by_near_miss(const Deviations& deviation) {
  std::optional<Limit> limit;
  for (const NearMissSensitivity& near_miss : deviation.study().near_misses) {
    const NearMiss& here = deviation.study().base.near_misses[near_miss.near_miss];
    const auto scatter = deviation.of(near_miss.by_key);
    if (scatter && deviations * *scatter < here.margin) continue;
    if (limit && limit->first <= near_miss.sub_impact) continue;
    const bool opens = here.kind == NearMissKind::opening;
    limit = {near_miss.sub_impact,
             fmt::format("at {:.6g} us the {} by {:.2g} um, {}", us * here.time,
                         opens ? "contact stays closed" : "gap stays open", um * here.margin,
                         scatter ? fmt::format("which scatters by {:.2g} um", um * *scatter)
                                 : "whose scatter is not known")};
  }
  return limit;
}

std::optional<Limit> limit_of(const Deviations& deviation) {
  std::optional<Limit> limit = limit_by_near_miss(deviation);
  const std::size_t n = deviation.study().base.sub_impacts.size();
  for (std::size_t i = 0; i < (limit ? std::min(limit->first, n) : n); ++i) {
    std::string reason = unpredictable_reason(deviation, i);
    if (!reason.empty()) return Limit{i, std::move(reason)};
  }
  return limit;
}

// The momentum that the striker loses from `first` to `last`: mass times change of velocity.
std::optional<double> impulse_deviation(const Deviations& deviation, std::size_t first,
                                        std::size_t last) {
  const Sensitivity& study = deviation.study();
  const double mass = study.input.scene.bodies().moving_mass();
  const ByKey* after = deviation.derivatives(EventQuantity::striker_velocity, last);
  if (after == nullptr) return std::nullopt;
  const double v0 = study.input.scene.bodies().velocity_scale();
  const double v_before = first > 0 ? study.base.sub_impacts[first - 1].striker_velocity : v0;
  const double v_after = study.base.sub_impacts[last].striker_velocity;
  ByKey before(study.keys.size());
  for (std::size_t k = 0; k < before.size(); ++k) {
    before[k] = Derivative{study.keys[k] == "striker.velocity" ? v0 : 0.0, 0.0};
  }
  if (first > 0) {
    const ByKey* known = deviation.derivatives(EventQuantity::striker_velocity, first - 1);
    if (known == nullptr) return std::nullopt;
    before = *known;
  }
  ByKey impulse = difference(before, *after);
  for (std::size_t k = 0; k < impulse.size(); ++k) {
    if (!impulse[k]) continue;
    const double by_mass = study.keys[k] == "striker.mass" ? v_before - v_after : 0.0;
    impulse[k] = {mass * (impulse[k]->value + by_mass), mass * impulse[k]->error};
  }
  return within_range(deviation.of(impulse), 2.0 * mass * v0);
}

std::vector<Predictability::Zone> zones_of(const Deviations& deviation) {
  const std::vector<SubImpact>& all = deviation.study().base.sub_impacts;
  std::vector<Predictability::Zone> zones;
  for (std::size_t first = 0; first < all.size();) {
    std::size_t last = first;
    while (last + 1 < all.size() && all[last + 1].zone == all[first].zone) ++last;
    const double end_time = deviation.study().input.end_time;
    zones.push_back({within_range(deviation.of(EventQuantity::start, first), end_time),
                     within_range(deviation.of(EventQuantity::end, last), end_time),
                     impulse_deviation(deviation, first, last)});
    first = last + 1;
  }
  return zones;
}

}  // namespace

std::optional<double> deviation_of(const std::vector<std::optional<Derivative>>& by_key,
                                   const std::vector<std::string>& keys, const Scatter& scatter) {
  double variance = 0.0;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const auto found = scatter.find(keys[k]);
    if (found == scatter.end() || found->second == 0.0) continue;
    if (!by_key[k]) return std::nullopt;
    const double change = (std::abs(by_key[k]->value) + by_key[k]->error) * found->second;
    variance += change * change;
  }
  return std::sqrt(variance);
}

void set_predictability(Result& result, const Sensitivity& study, const Scatter& scatter) {
  const Deviations deviation(study, scatter);
  std::vector<SubImpact>& all = result.sub_impacts;
  const std::vector<MatchedPair> pairs = match_sub_impacts(all, study.base.sub_impacts);
  for (const MatchedPair& pair : pairs) {
    if (!pair.first || !pair.second) continue;
    SubImpact& here = all[*pair.first];
    const auto scatter_of = [&](EventQuantity quantity) {
      return within_range(deviation.of(quantity, *pair.second), study.input.end_time);
    };
    here.start_scatter = scatter_of(EventQuantity::start);
    if (here.end) here.end_scatter = scatter_of(EventQuantity::end);
  }
  Predictability found;
  if (const std::optional<Limit> limit = limit_of(deviation)) {
    found.first_unpredictable = limit->first;
    found.reason = limit->reason;
  }
  const std::size_t n_same = n_leading_matches(pairs);
  const bool is_same = n_same == all.size() && n_same == study.base.sub_impacts.size();
  if (!is_same && found.first_unpredictable.value_or(n_same) >= n_same) {
    found.first_unpredictable = n_same;
    found.reason =
        "the runs for derivatives, at a tighter tolerance or on a coarser mesh, have other "
        "sub-impacts from here on";
  }
  const std::size_t n = std::min(found.first_unpredictable.value_or(all.size()), all.size());
  for (std::size_t i = 0; i < n; ++i) {
    found.horizon = result.end_of(all[i]);
    found.largest_scatter = std::max({found.largest_scatter, all[i].start_scatter.value_or(0.0),
                                      all[i].end_scatter.value_or(0.0)});
  }
  if (!found.first_unpredictable) found.horizon = result.outcome.time;
  found.zones = zones_of(deviation);
  if (!study.base.sub_impacts.empty()) {
    found.striker_velocity_scatter = within_range(
        deviation.of(EventQuantity::striker_velocity, study.base.sub_impacts.size() - 1),
        2.0 * study.input.scene.bodies().velocity_scale());
  }
  result.predictability = std::move(found);
}

std::vector<std::string> scattering_keys(const Case& input) {
  std::vector<std::string> keys;
  for (const std::string& name : shifted_keys(input)) {
    const auto found = input.scatter.find(name);
    if (found != input.scatter.end() && found->second > 0.0) keys.push_back(name);
  }
  return keys;
}

void add_predictability(Result& result, const Case& input, SensitivityOptions options) {
  options.keys = scattering_keys(input);
  if (options.keys.empty()) return;
  const double n_runs = runs_for_derivatives(static_cast<double>(options.keys.size()));
  const Sensitivity study = sensitivity(affordable_case(sensitivity_case(input), n_runs), options);
  if (study.interrupted) {
    result.warnings.emplace_back("interrupted before the scatter of the event times was known");
    return;
  }
  if (!study.base.outcome.completed() || study.keys.size() < options.keys.size()) {
    result.warnings.push_back(fmt::format(
        "the scatter of the event times is not known: {}",
        study.base.outcome.completed() ? study.remarks.back() : study.base.outcome.message));
    return;
  }
  set_predictability(result, study, input.scatter);
  if (const std::size_t n = add_samples(*result.predictability, input, options); n > 0) {
    result.warnings.push_back(fmt::format(
        "{} of {} runs with sampled numbers did not complete, and the scatter is without them", n,
        most_samples));
  }
}

}  // namespace subimpact
