#include "subimpact/study/population.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>

#include "numerics/random.h"
#include "study/parallel.h"

namespace subimpact {
namespace {

using Settings = std::vector<std::pair<std::string, KeyValue>>;

constexpr int most_draws = 1000;  // of one number

// Box and Muller's transform.
double normal(SplitMix64& random) {
  const double r = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
  return r * std::cos(2.0 * std::numbers::pi * random.uniform());
}

std::optional<double> number_of(const std::optional<KeyValue>& value) {
  if (!value) return std::nullopt;
  if (const auto* whole = std::get_if<std::int64_t>(&*value)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&*value)) return *real;
  return std::nullopt;
}

double scattered(const CaseKey& key, double value, double deviation, SplitMix64& random) {
  for (int draw = 0; draw < most_draws; ++draw) {
    const double other = value * std::exp(deviation * normal(random));
    if (!problem_with(key, other)) return other;
  }
  throw InvalidCase(key.name, fmt::format("scatters out of its range: no value of {} draws about "
                                          "{:g} is allowed; make its scatter smaller",
                                          most_draws, value));
}

void check_axis(const PopulationAxis& axis, std::set<std::string>& seen) {
  for (std::size_t k = 0; k < axis.keys.size(); ++k) {
    const CaseKey& key = known_key(axis.keys[k]);
    if (!seen.insert(key.name).second) {
      throw InvalidCase(key.name, "is on two axes; give its values on one of them");
    }
    if (axis.points.empty()) throw InvalidCase(key.name, "has no values on its axis");
    for (const std::vector<KeyValue>& point : axis.points) {
      if (point.size() != axis.keys.size()) {
        throw InvalidCase(key.name, fmt::format("changes together with others: every point of the "
                                                "axis needs {} values, and one has {}",
                                                axis.keys.size(), point.size()));
      }
      if (const auto problem = problem_with(key, point[k])) throw InvalidCase(key.name, *problem);
    }
  }
}

void check_scatter(const CaseKey& key, double deviation, const std::optional<KeyValue>& value) {
  if (key.type != KeyType::number) {
    throw InvalidCase(key.name, "is no number, and cannot scatter");
  }
  const std::optional<double> number = number_of(value);
  if (!number || !std::isfinite(*number)) {
    throw InvalidCase(key.name, "has no finite value in the base case about which to scatter");
  }
  if (!(deviation > 0.0 && deviation <= 0.5)) {
    throw InvalidCase(key.name, fmt::format("has a scatter of {:g}; allowed: a relative standard "
                                            "deviation above 0, up to 0.5, such as 0.01",
                                            deviation));
  }
}

std::optional<KeyValue> first_value(const std::vector<PopulationAxis>& axes, const CaseKey& key,
                                    const Case& base) {
  for (const PopulationAxis& axis : axes) {
    const auto found = std::ranges::find(axis.keys, key.name);
    if (found != axis.keys.end()) {
      return axis.points.front()[static_cast<std::size_t>(found - axis.keys.begin())];
    }
  }
  return key.get(base);
}

}  // namespace

std::size_t Population::size() const {
  constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
  std::size_t n = n_samples;
  for (const PopulationAxis& axis : axes) {
    const std::size_t points = axis.points.size();
    if (points != 0 && n > most / points) throw InvalidCase("axes", "have too many combinations");
    n *= points;
  }
  return n;
}

std::vector<std::string> Population::keys() const {
  std::vector<std::string> names;
  for (const PopulationAxis& axis : axes) {
    names.insert(names.end(), axis.keys.begin(), axis.keys.end());
  }
  for (const auto& [name, deviation] : scatter) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

Settings Population::settings(const Case& base, std::size_t number) const {
  Settings settings;
  std::size_t combination = number / n_samples;
  std::vector<const std::vector<KeyValue>*> points(axes.size());
  for (std::size_t a = axes.size(); a-- > 0;) {
    points[a] = &axes[a].points[combination % axes[a].points.size()];
    combination /= axes[a].points.size();
  }
  for (std::size_t a = 0; a < axes.size(); ++a) {
    for (std::size_t k = 0; k < axes[a].keys.size(); ++k) {
      settings.emplace_back(axes[a].keys[k], (*points[a])[k]);
    }
  }
  SplitMix64 random(SplitMix64(seed).next() ^ (number % n_samples * 0xd1342543de82ef95ULL));
  random.next();
  for (const auto& [name, deviation] : scatter) {
    const CaseKey& key = known_key(name);
    auto place = std::ranges::find(settings, name, &Settings::value_type::first);
    const double value = *number_of(place != settings.end() ? place->second : key.get(base));
    if (place == settings.end()) place = settings.emplace(place, name, KeyValue());
    place->second = scattered(key, value, deviation, random);
  }
  return settings;
}

std::map<std::string, double> scatter_of(const Case& base,
                                         const std::vector<PopulationAxis>& axes) {
  std::map<std::string, double> scatter;
  for (const auto& [name, deviation] : base.scatter) {
    const std::optional<double> number = number_of(first_value(axes, known_key(name), base));
    const bool is_drawn = number && std::isfinite(*number) && *number != 0.0;
    if (deviation > 0.0 && is_drawn) scatter[name] = deviation;
  }
  return scatter;
}

void check(const Population& population, const Case& base) {
  std::set<std::string> seen;
  for (const PopulationAxis& axis : population.axes) check_axis(axis, seen);
  if (population.n_samples == 0)
    throw InvalidCase("samples", "are 0 in number; allowed: 1 or more");
  for (const auto& [name, deviation] : population.scatter) {
    const CaseKey& key = known_key(name);
    check_scatter(key, deviation, first_value(population.axes, key, base));
  }
  population.size();
}

std::vector<Result> sweep(const Case& base, const Population& population, unsigned jobs) {
  check(population, base);
  std::vector<Case> cases(population.size(), base);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    cases[i].output.keep_no_rows();
    for (const auto& [key, value] : population.settings(base, i)) {
      assign(cases[i], known_key(key), value);
    }
  }
  return simulate_all(cases, std::max(jobs, 1u));
}

}  // namespace subimpact
