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
constexpr RunNumber totals[] = {
    {"sub_impacts", [](const Result& run) { return static_cast<double>(run.sub_impacts.size()); }},
    {"restitution", [](const Result& run) { return run.restitution.value_or(NAN); }},
    {"striker_velocity_m_per_s", [](const Result& run) { return run.striker_velocity; }},
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

}  // namespace

Case affordable_case(const Case& input, double n_runs) {
  const std::optional<RefinedRun> coarse = on_other_mesh(input, tried);
  if (!coarse) return input;
  NoRows none;
  const Result run = simulate(coarse->input, {}, nullptr, &none);
  const double all = n_runs * counted_work(coarse->input, run);
  const double ratio = tried * std::pow(most_work_of_scatter / all, 1.0 / usual_growth);
  if (ratio >= 1.0) return input;
  const std::optional<RefinedRun> affordable = on_other_mesh(input, std::max(ratio, coarsest));
  return affordable ? affordable->input : coarse->input;
}

void add_samples(Predictability& predictability, const Case& input,
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
    NoRows none;
    const Result run = simulate(sample(base, population, number), options.progress, nullptr, &none);
    const std::lock_guard lock(mutex);
    if (options.finished) options.finished(++n_done, most_samples);
    if (!run.outcome.completed()) return;
    std::ranges::transform(totals, samples[number].emplace().begin(),
                           [&](const RunNumber& total) { return total.of(run); });
  });
  std::erase(samples, std::nullopt);
  if (2 * samples.size() < most_samples) return;
  predictability.n_samples = samples.size();
  predictability.samples_mesh = mesh_words(base);
  for (std::size_t k = 0; k < std::size(totals); ++k) {
    std::vector<double> values;
    for (const auto& of_one : samples) values.push_back((*of_one)[k]);
    if (std::ranges::any_of(values, [](double x) { return std::isnan(x); })) continue;
    predictability.totals.push_back(summary_of(totals[k].name, std::move(values)));
    if (totals[k].name == std::string("striker_velocity_m_per_s")) {
      predictability.striker_velocity_scatter = predictability.totals.back().deviation;
    }
  }
}

}  // namespace subimpact
