#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>

#include "study/judgement/totals.h"
#include "study/parallel.h"
#include "study/refinement/refinement.h"
#include "subimpact/study/other_mesh.h"
#include "subimpact/study/population.h"
#include "subimpact/study/sensitivity/predictability.h"

namespace subimpact {
namespace {

constexpr double tried = 0.25;  // of the mesh, to know what a run takes
constexpr double coarsest = 0.125;

// Columns of strikes.csv; not a number where a sample has no such thing yet.
struct RunNumber {
  const char* name;
  double (*of)(const Result&);
};
double velocity_of(const Result& run) { return run.striker_velocity; }
constexpr RunNumber totals[] = {
    {"sub_impacts", [](const Result& run) { return static_cast<double>(run.sub_impacts.size()); }},
    {"restitution", [](const Result& run) { return run.restitution.value_or(NAN); }},
    {"striker_velocity_m_per_s", velocity_of},
    {"peak_force_N", [](const Result& run) { return run.max_force; }},
    {"impulse_Ns", [](const Result& run) { return run.impulse(); }},
    {"dent_m",
     [](const Result& run) {
       return run.sub_impacts.empty() ? 0.0 : run.sub_impacts.back().residual_indentation;
     }},
    {"permanent_set_m", [](const Result& run) {
       return largest_magnitude(run.envelope, &EnvelopeRow::set_from_supports);
     }}};

using Values = std::array<double, std::size(totals)>;

// Of sorted values, linear between them.
double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], at - static_cast<double>(below));
}

Predictability::Sampled summary_of(const char* name, std::vector<double> values) {
  std::ranges::sort(values);
  const auto n = static_cast<double>(values.size());
  const double mean = std::reduce(values.begin(), values.end()) / n;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {name, mean, std::sqrt(squares / (n - 1.0)), quantile(values, 0.05),
          quantile(values, 0.95)};
}

Case sample(const Case& base, const Population& population, std::size_t number) {
  Case input = base;
  for (const auto& [key, value] : population.settings(base, number))
    assign(input, known_key(key), value);
  return input;
}

// Nothing where the scene does not allow the mesh.
std::optional<Case> resized(const Case& input, double ratio) {
  const std::optional<RefinedRun> other = on_other_mesh(input, ratio);
  if (!other) return std::nullopt;
  try {
    resolve(other->input);
  } catch (const InvalidCase&) {
    return std::nullopt;
  }
  return other->input;
}

// Nothing where numbers do not go together, or the run does not complete.
std::optional<Values> values_of(const Case& input, const Progress& progress) {
  try {
    NoRows none;
    const Result run = simulate(input, progress, nullptr, &none);
    if (!run.outcome.completed()) return std::nullopt;
    Values values;
    std::ranges::transform(totals, values.begin(),
                           [&](const RunNumber& total) { return total.of(run); });
    return values;
  } catch (const InvalidCase&) {
    return std::nullopt;
  }
}

}  // namespace

Case affordable_case(const Case& input, double n_runs) {
  const std::optional<Case> coarse = resized(input, tried);
  if (!coarse) return input;
  NoRows none;
  const Result run = simulate(*coarse, {}, nullptr, &none);
  const double all = n_runs * counted_work(*coarse, run);
  const double ratio = tried * std::pow(most_work_of_scatter / all, 1.0 / usual_growth);
  if (ratio >= 1.0) return input;
  return resized(input, std::max(ratio, coarsest)).value_or(*coarse);
}

std::size_t add_samples(Predictability& predictability, const Case& input,
                        const SensitivityOptions& options) {
  Case base = affordable_case(input, most_samples);
  base.accuracy.event_times.reset();
  Population population;
  population.scatter = scatter_of(base, {});
  population.n_samples = most_samples;
  std::vector<std::optional<Values>> samples(most_samples);
  std::size_t n_done = 0;
  std::mutex mutex;
  in_parallel(most_samples, options.jobs, [&](std::size_t number) {
    samples[number] = values_of(sample(base, population, number), options.progress);
    const std::lock_guard lock(mutex);
    if (options.finished) options.finished(++n_done, most_samples);
  });
  const auto n_missing = static_cast<std::size_t>(std::erase(samples, std::nullopt));
  if (2 * n_missing > most_samples) return n_missing;
  predictability.n_samples = samples.size();
  predictability.samples_mesh = mesh_words(base);
  const std::optional<Values> nominal = values_of(base, options.progress);
  for (std::size_t k = 0; k < std::size(totals); ++k) {
    std::vector<double> values;
    for (const auto& of_one : samples) values.push_back((*of_one)[k]);
    if (std::ranges::any_of(values, [](double x) { return std::isnan(x); })) continue;
    predictability.totals.push_back(summary_of(totals[k].name, std::move(values)));
    if (nominal) predictability.totals.back().nominal = (*nominal)[k];
    if (totals[k].of == velocity_of) {
      predictability.striker_velocity_scatter = predictability.totals.back().deviation;
    }
  }
  return n_missing;
}

}  // namespace subimpact
