#include "predictability/ensemble.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>

#include "study/parallel.h"
#include "subimpact/study/judgement/match.h"

namespace subimpact::predictability {
namespace {

struct Sample {
  Case input;
  std::vector<double> shifts;  // of ln p, by key of the study
};

Sample draw(const Sensitivity& study, const Population& population, double rtol,
            std::size_t number) {
  Sample sample{study.input, std::vector<double>(study.keys.size(), 0.0)};
  sample.input.solver.rtol = rtol;
  for (const auto& [name, value] : population.settings(study.input, number)) {
    const CaseKey& key = *find_case_key(name);
    const auto k = std::ranges::find(study.keys, name) - study.keys.begin();
    sample.shifts.at(static_cast<std::size_t>(k)) =
        std::log(std::get<double>(value) / std::get<double>(*key.get(study.input)));
    assign(sample.input, key, value);
  }
  return sample;
}

// The sub-impacts of the base run, moved by what the derivatives foresee.
std::vector<SubImpact> predicted(const Sensitivity& study, const std::vector<double>& shifts) {
  std::vector<SubImpact> moved = study.base.sub_impacts;
  for (const SensitivityRow& row : study.rows) {
    double change = 0.0;
    for (std::size_t k = 0; k < shifts.size(); ++k) {
      if (row.by_key[k]) change += row.by_key[k]->value * shifts[k];
    }
    SubImpact& s = moved[row.sub_impact];
    if (row.quantity == EventQuantity::start) s.start += change;
    if (row.quantity == EventQuantity::end) *s.end += change;
  }
  return moved;
}

struct Moments {
  std::size_t n = 0;
  double mean = 0.0, squares = 0.0;  // of the differences from the mean
  void add(double x) {
    ++n;
    const double before = x - mean;
    mean += before / static_cast<double>(n);
    squares += before * (x - mean);
  }
  double deviation() const { return n > 1 ? std::sqrt(squares / static_cast<double>(n - 1)) : 0.0; }
};

}  // namespace

Ensemble ensemble(const Sensitivity& study, const Scatter& scatter,
                  const EnsembleOptions& options) {
  const Population population{{}, scatter, options.n_runs, options.seed};
  std::vector<std::optional<Result>> runs(options.n_runs);
  std::vector<std::vector<double>> shifts(options.n_runs);
  std::atomic<bool> stop = false;
  std::mutex mutex;
  std::size_t n_done = 0;
  in_parallel(options.n_runs, options.jobs, [&](std::size_t i) {
    Sample sample = draw(study, population, options.rtol, i);
    shifts[i] = std::move(sample.shifts);
    Result run = simulate(sample.input, [&](double time) {
      if (options.progress && !options.progress(time)) stop = true;
      return !stop;
    });
    run.transitions.clear();
    run.transitions.shrink_to_fit();
    if (run.outcome.completed()) runs[i] = std::move(run);
    const std::lock_guard lock(mutex);
    if (options.finished) options.finished(++n_done);
  });

  Ensemble result;
  result.interrupted = stop;
  const std::size_t n = study.base.sub_impacts.size();
  result.events.resize(n);
  std::vector<Moments> starts(n), ends(n);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (!runs[k]) {
      ++result.n_failed;
      continue;
    }
    const Counterparts found = counterparts(predicted(study, shifts[k]), runs[k]->sub_impacts);
    bool has_changed = false;
    for (std::size_t i = 0; i < n; ++i) {
      const SubImpact* there = found.of[i];
      const bool changed = there == nullptr || found.follows_new_one[i];
      has_changed = has_changed || changed;
      result.events[i].n_changed += changed ? 1 : 0;
      result.events[i].n_changed_so_far += has_changed ? 1 : 0;
      if (there == nullptr) continue;
      ++result.events[i].n_present;
      starts[i].add(there->start);
      if (there->end) ends[i].add(*there->end);
    }
    result.runs.push_back(std::move(*runs[k]));
  }
  for (std::size_t i = 0; i < n; ++i) {
    EnsembleEvent& event = result.events[i];
    event.start_mean = starts[i].mean;
    event.start_deviation = starts[i].deviation();
    event.end_mean = ends[i].mean;
    event.end_deviation = ends[i].deviation();
  }
  return result;
}

}  // namespace subimpact::predictability
