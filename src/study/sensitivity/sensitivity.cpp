#include "subimpact/study/sensitivity/sensitivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "case/problem.h"
#include "case/shifted_case.h"
#include "numerics/estimates.h"
#include "simulate/settings/methods.h"
#include "study/method_choice.h"
#include "study/parallel.h"
#include "study/sensitivity/stencil.h"
#include "subimpact/study/judgement/match.h"

namespace subimpact {
namespace {

constexpr double tightest = 1e-13;        // rtol
constexpr double looser = 10.0;           // of the run that shows the error of the base run
constexpr double unreliable_share = 0.1;  // of the largest derivative of a row
constexpr double graze_share = 3.0;       // of the change of a margin over the larger shift
constexpr double bent_share = 0.05;       // of the largest derivative of a row, between the shifts

constexpr std::size_t n_runs_per_key = 2 * sensitivity_shifts.size();

// In the order of EventQuantity.
struct {
  std::string_view name;
  double (*value)(const SubImpact&);
} constexpr quantities[] = {
    {"start_s", [](const SubImpact& s) { return s.start; }},
    {"end_s", [](const SubImpact& s) { return *s.end; }},
    {"peak_force_N", [](const SubImpact& s) { return s.peak_force; }},
    {"impulse_Ns", [](const SubImpact& s) { return s.impulse; }},
    {"max_indentation_m", [](const SubImpact& s) { return s.max_indentation; }},
    {"striker_velocity_m_per_s", [](const SubImpact& s) { return s.striker_velocity; }}};
static_assert(std::size(quantities) == event_quantities.size());

// A run of another accuracy in time, and the error of the base run as a share of the difference.
struct CheckRun {
  Case input;
  double share;
};

CheckRun check_run_of(const Case& base) {
  CheckRun check{base, 1.0 / (looser - 1.0)};
  if (base.solver.step) {
    *check.input.solver.step *= 0.5;
    check.share = 4.0 / 3.0;  // of second order
  } else {
    check.input.solver.rtol *= looser;
  }
  return check;
}

std::vector<const CaseKey*> keys_of(const Case& input, const std::vector<std::string>& names) {
  std::vector<const CaseKey*> keys;
  for (const std::string& name : names.empty() ? sensitivity_keys(input) : names) {
    const CaseKey& key = known_key(name);
    if (const auto reason = why_not_shifted(input, key)) throw InvalidCase(name, *reason);
    keys.push_back(&key);
  }
  return keys;
}

// Plus and minus the larger shift, then the smaller one, key by key.
std::vector<Case> shifted_cases(const Case& base, const std::vector<const CaseKey*>& keys) {
  std::vector<Case> cases;
  for (const CaseKey* key : keys) {
    for (const double shift : sensitivity_shifts) {
      for (const double sign : {1.0, -1.0}) {
        cases.push_back(shifted(base, *key, sign * shift));
        check(cases.back());
      }
    }
  }
  return cases;
}

// A number of the base run and of the shifted runs of a key, in the order of shifted_cases(); none
// where one of these lacks it.
template <class ValueIn>
std::optional<Stencil> stencil_of(double base, ValueIn value_in) {
  Stencil s;
  s.base = base;
  for (std::size_t run = 0; run < n_runs_per_key; ++run) {
    const std::optional<double> value = value_in(run);
    if (!value) return std::nullopt;
    (run % 2 == 0 ? s.plus : s.minus)[run / 2] = *value;
  }
  return s;
}

Smoothness smoothness_of(const Result& base) {
  return base.n_yielded_sections > 0 ? Smoothness::between_thresholds : Smoothness::everywhere;
}

/// Derives one quantity after the other from the runs of a study.
class Differences {
 public:
  /// `share`: of its differences from the check run, the error of the base run.
  Differences(const Result& base, const Result& check_run, double share,
              const std::vector<Result>& shifted_runs, const std::vector<std::string>& keys)
      : base_(base.sub_impacts),
        check_(counterparts(base_, check_run.sub_impacts)),
        share_(share),
        n_keys_(keys.size()),
        smoothness_(smoothness_of(base)) {
    for (const std::string& key : keys) of_beam_.push_back(key.starts_with("beam."));
    for (const Result& run : shifted_runs) shifted_.push_back(counterparts(base_, run.sub_impacts));
  }

  /// The error of one run in a number of a sub-impact, as the runs of keys like this one show it:
  /// numbers of the beam change its matrices, whose rounding adds to the errors.
  double run_error(EventQuantity quantity, std::size_t i, std::size_t key) const {
    double error = 0.0;
    const std::size_t last = std::min(i + 1, base_.size() - 1);
    for (std::size_t k = i > 0 ? i - 1 : 0; k <= last; ++k) {
      error = std::max(error, error_of_one(quantity, k, key));
    }
    return error;
  }

  /// The error of one number of the base run, as the check run shows it.
  double check_error(EventQuantity quantity, std::size_t i) const {
    const auto here = value_of(base_[i], quantity);
    const auto there = check_.of[i] != nullptr ? value_of(*check_.of[i], quantity) : std::nullopt;
    return here && there ? share_ * std::abs(*here - *there) : 0.0;
  }

  std::optional<Stencil> stencil(EventQuantity quantity, std::size_t i, std::size_t key) const {
    const std::optional<double> base = value_of(base_[i], quantity);
    if (!base) return std::nullopt;
    return stencil_of(*base, [&](std::size_t run) {
      const SubImpact* other = shifted_[key * n_runs_per_key + run].of[i];
      return other != nullptr ? value_of(*other, quantity) : std::nullopt;
    });
  }

  bool follows_new_one(std::size_t i, std::size_t key) const {
    const auto first = shifted_.begin() + static_cast<std::ptrdiff_t>(key * n_runs_per_key);
    return std::any_of(first, first + n_runs_per_key,
                       [i](const Counterparts& run) { return run.follows_new_one[i]; });
  }
  Smoothness smoothness() const { return smoothness_; }

 private:
  double error_of_one(EventQuantity quantity, std::size_t i, std::size_t like) const {
    std::vector<double> noises;
    for (std::size_t key = 0; key < n_keys_; ++key) {
      if (of_beam_[key] != of_beam_[like]) continue;
      if (const auto s = stencil(quantity, i, key)) noises.push_back(noise_of(*s));
    }
    return std::max(median(std::move(noises)), check_error(quantity, i));
  }

  const std::vector<SubImpact>& base_;
  Counterparts check_;
  double share_;
  std::vector<Counterparts> shifted_;
  std::size_t n_keys_;
  Smoothness smoothness_;
  std::vector<bool> of_beam_;
};

SensitivityRow row_of(const Differences& differences, EventQuantity quantity, std::size_t i,
                      double value, const std::vector<std::string>& keys) {
  SensitivityRow row{quantity, i, value, {}, {}};
  const auto flag = [&](const std::string& words, const std::string& key) {
    if (row.flag.empty()) row.flag = fmt::format("{} {}", words, key);
  };
  double largest = 0.0;
  std::vector<double> bends;
  for (std::size_t key = 0; key < keys.size(); ++key) {
    const std::optional<Stencil> s = differences.stencil(quantity, i, key);
    const double error = differences.run_error(quantity, i, key);
    row.by_key.push_back(s ? std::optional(derivative_of(*s, error, differences.smoothness()))
                           : std::nullopt);
    if (!s) flag("merges, splits or vanishes within the shifts of", keys[key]);
    if (s) largest = std::max(largest, std::abs(row.by_key.back()->value));
    if (s && has_kink(*s, differences.check_error(quantity, i))) flag("has a kink in", keys[key]);
    bends.push_back(s ? bend_of_slope(*s, error) : 0.0);
  }
  for (std::size_t key = 0; key < keys.size(); ++key) {
    if (differences.follows_new_one(i, key)) {
      flag("a contact appears before it within the shifts of", keys[key]);
    }
    if (bends[key] > bent_share * largest) {
      flag("is about to merge, split or vanish with", keys[key]);
    }
    const auto& derivative = row.by_key[key];
    if (derivative && derivative->error > unreliable_share * largest) {
      flag("the shifts disagree in", keys[key]);
    }
  }
  return row;
}

std::vector<NearMissSensitivity> near_misses_of(const Result& base,
                                                const std::vector<Result>& shifted_runs,
                                                std::size_t n_keys) {
  std::vector<std::vector<std::optional<std::size_t>>> partners;
  for (const Result& run : shifted_runs) {
    const std::size_t n = n_leading_matches(match_sub_impacts(base.sub_impacts, run.sub_impacts));
    partners.push_back(match_near_misses(base, run, n));
  }
  std::vector<NearMissSensitivity> list;
  for (std::size_t i = 0; i < base.near_misses.size(); ++i) {
    const NearMiss& here = base.near_misses[i];
    NearMissSensitivity row{i, first_in_doubt(base, here), {}};
    for (std::size_t key = 0; key < n_keys; ++key) {
      const auto s = stencil_of(here.margin, [&](std::size_t k) -> std::optional<double> {
        const std::size_t run = key * n_runs_per_key + k;
        if (i >= partners[run].size() || !partners[run][i]) return std::nullopt;
        return shifted_runs[run].near_misses[*partners[run][i]].margin;
      });
      row.by_key.push_back(s ? std::optional(derivative_of(*s, noise_of(*s), smoothness_of(base)))
                             : std::nullopt);
    }
    list.push_back(std::move(row));
  }
  return list;
}

// Flags sub-impacts that a near miss makes uncertain: one that the shifts nearly reach.
void flag_near_misses(Sensitivity& study) {
  for (const NearMissSensitivity& near_miss : study.near_misses) {
    const double margin = study.base.near_misses[near_miss.near_miss].margin;
    for (std::size_t key = 0; key < study.keys.size(); ++key) {
      const auto& derivative = near_miss.by_key[key];
      const double change = derivative ? std::abs(derivative->value) * sensitivity_shifts[0] : 0.0;
      if (graze_share * change < margin) continue;
      for (SensitivityRow& row : study.rows) {
        if (row.sub_impact == near_miss.sub_impact && row.flag.empty()) {
          row.flag = "a near miss is within the shifts of " + study.keys[key];
        }
      }
    }
  }
}

// Flags the last sub-impact where a shifted run has one more.
void flag_later_contacts(Sensitivity& study, const std::vector<Result>& shifted_runs) {
  for (std::size_t run = 0; run < shifted_runs.size(); ++run) {
    const auto pairs = match_sub_impacts(study.base.sub_impacts, shifted_runs[run].sub_impacts);
    if (pairs.empty() || pairs.back().first) continue;
    for (SensitivityRow& row : study.rows) {
      if (row.sub_impact + 1 < study.base.sub_impacts.size() || !row.flag.empty()) continue;
      row.flag =
          "a contact appears after it within the shifts of " + study.keys[run / n_runs_per_key];
    }
  }
}

// Leaves out the keys of which a run did not complete.
void drop_incomplete(Sensitivity& study, std::vector<Result>& shifted_runs) {
  std::vector<std::string> keys;
  std::vector<Result> kept;
  for (std::size_t key = 0; key < study.keys.size(); ++key) {
    const auto first = shifted_runs.begin() + static_cast<std::ptrdiff_t>(key * n_runs_per_key);
    const auto last = first + n_runs_per_key;
    const auto failed =
        std::find_if(first, last, [](const Result& run) { return !run.outcome.completed(); });
    if (failed == last) {
      keys.push_back(study.keys[key]);
      std::move(first, last, std::back_inserter(kept));
    } else if (failed->outcome.kind != OutcomeKind::stopped) {
      study.remarks.push_back(
          fmt::format("no derivatives by {}: a run with a shifted value ended {}: {}",
                      study.keys[key], to_string(failed->outcome.kind), failed->outcome.message));
    }
  }
  study.keys = std::move(keys);
  shifted_runs = std::move(kept);
}

std::vector<std::string> remarks_on(const Case& input, const Case& base) {
  std::vector<std::string> remarks;
  if (base.solver.method != input.solver.method) {
    remarks.push_back(fmt::format(
        "by {} in place of {}, whose interpolated events jump with the phase of its steps",
        to_string(base.solver.method), to_string(input.solver.method)));
  } else if (base.solver.rtol != input.solver.rtol && !base.solver.step) {
    remarks.push_back(
        fmt::format("at rtol {:g} in place of {:g}, whose errors would hide the shifts",
                    base.solver.rtol, input.solver.rtol));
  }
  return remarks;
}

}  // namespace

std::string_view to_string(EventQuantity quantity) {
  return quantities[static_cast<std::size_t>(quantity)].name;
}

std::optional<double> value_of(const SubImpact& s, EventQuantity quantity) {
  if (quantity != EventQuantity::start && !s.end) return std::nullopt;
  return quantities[static_cast<std::size_t>(quantity)].value(s);
}

const SensitivityRow* Sensitivity::find(EventQuantity quantity, std::size_t sub_impact) const {
  const auto found = std::ranges::find_if(rows, [&](const SensitivityRow& row) {
    return row.quantity == quantity && row.sub_impact == sub_impact;
  });
  return found != rows.end() ? &*found : nullptr;
}

std::vector<std::string> sensitivity_keys(const Case& input) { return shifted_keys(input); }

Case sensitivity_case(const Case& input) {
  Case base = input;
  if (events_of(input) == EventHandling::interpolated) {
    base.solver = {};
    base.solver.method = possible_method(input, Method::nystrom);
  }
  base.solver.rtol = std::min(input.solver.rtol, tightest);
  base.accuracy.event_times.reset();
  base.output.keep_no_rows();
  if (const auto step = resolve(base).settings().step) base.solver.step = step;
  return base;
}

Sensitivity sensitivity(const Case& input, const SensitivityOptions& options) {
  Sensitivity study;
  study.input = sensitivity_case(input);
  study.remarks = remarks_on(input, study.input);
  const std::vector<const CaseKey*> keys = keys_of(study.input, options.keys);
  for (const CaseKey* key : keys) study.keys.push_back(key->name);
  const std::vector<Case> cases = shifted_cases(study.input, keys);

  std::size_t n_done = 0;
  const auto run = [&](const std::vector<Case>& some) {
    std::vector<Result> results = simulate_all(some, options.jobs, options.progress, [&] {
      ++n_done;
      if (options.finished) options.finished(n_done, cases.size() + 2);
    });
    study.interrupted |= std::ranges::any_of(
        results, [](const Result& result) { return result.outcome.kind == OutcomeKind::stopped; });
    return results;
  };
  const CheckRun check_run = check_run_of(study.input);
  std::vector<Result> first = run({study.input, check_run.input});
  study.base = std::move(first[0]);
  if (!study.base.outcome.completed()) {
    study.keys.clear();
    return study;
  }
  std::vector<Result> shifted_runs = run(cases);
  drop_incomplete(study, shifted_runs);

  const Differences differences(study.base, first[1], check_run.share, shifted_runs, study.keys);
  for (std::size_t i = 0; i < study.base.sub_impacts.size(); ++i) {
    for (const EventQuantity quantity : event_quantities) {
      const auto value = value_of(study.base.sub_impacts[i], quantity);
      if (value) study.rows.push_back(row_of(differences, quantity, i, *value, study.keys));
    }
  }
  study.near_misses = near_misses_of(study.base, shifted_runs, study.keys.size());
  flag_near_misses(study);
  flag_later_contacts(study, shifted_runs);
  return study;
}

}  // namespace subimpact
