#include "numerics/event_free_horizon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "numerics/lanes.h"

namespace subimpact {

// Intervals, in radians of the fastest oscillator: the longest, the factor between levels, and
// their number. Any choice will do: 16 to 256 radians, factors of 2 to 16 and 3 to 9 levels down to
// 1/16 to 1 radian change the evaluations of the published example by 2 % at most.
constexpr double longest_radians = 64.0;
constexpr std::size_t factor = 4;
constexpr std::size_t n_levels = 5;
// Longest horizon, in intervals of the first level. Each adds a rounding error to the samples, all
// of them 4096 * 2^-53 = 5e-13 of the amplitudes.
constexpr double most_intervals = 4096.0;

EventFreeHorizon::EventFreeHorizon(std::vector<double> frequencies, std::vector<double> functions)
    : omega_(std::move(frequencies)),
      functions_(std::move(functions)),
      n_(omega_.size()),
      n_uniform_(0),
      amplitudes_(n_),
      levels_(n_levels) {
  while (n_uniform_ < n_ && omega_[n_uniform_] == 0.0) ++n_uniform_;
  double interval = longest_radians / omega_.back();
  for (Level& level : levels_) {
    level.interval = interval;
    for (const double w : omega_) {
      if (w * interval < std::sqrt(8.0)) ++level.n_kept;
      level.cosine.push_back(std::cos(w * interval));
      level.sine_over_omega.push_back(w > 0.0 ? std::sin(w * interval) / w : interval);
      level.minus_omega_sine.push_back(-w * w * level.sine_over_omega.back());
    }
    for (auto* numbers : {&level.bounds, &level.z, &level.rates}) numbers->resize(n_);
    for (auto* numbers : {&level.margins, &level.values}) numbers->resize(n_functions());
    level.functions.reserve(n_functions());
    interval /= factor;
  }
}

double EventFreeHorizon::from(std::span<const double> z, std::span<const double> rates,
                              std::span<const double> low, std::span<const double> high,
                              double longest) {
  low_ = low;
  high_ = high;
  for (std::size_t k = n_uniform_; k < n_; ++k) {
    amplitudes_[k] = std::hypot(z[k], rates[k] / omega_[k]);
  }
  for (Level& level : levels_) {
    for (std::size_t k = 0; k < n_; ++k) {
      const double angle = omega_[k] * level.interval;
      level.bounds[k] = amplitudes_[k] * std::min(1.0, angle * angle / 8.0);
    }
    std::ranges::fill(level.margins, -1.0);
  }
  time_of_largest_ = time_of_smallest_ = 0.0;
  largest_ = -std::numeric_limits<double>::infinity();
  smallest_ = -largest_;
  Level& first = levels_.front();
  first.functions.clear();
  for (std::size_t i = 0; i < n_functions(); ++i) {
    if (!stays_within_limits(i)) first.functions.push_back(i);
  }
  std::copy(z.begin(), z.end(), first.z.begin());
  std::copy(rates.begin(), rates.end(), first.rates.begin());
  const double n = std::min(std::ceil(longest / first.interval), most_intervals);
  return std::min(event_free_time(0, static_cast<std::size_t>(n)), longest);
}

bool EventFreeHorizon::stays_within_limits(std::size_t i) const {
  const double* g = functions_.data() + i * n_;
  if (std::any_of(g, g + n_uniform_, [](double share) { return share != 0.0; })) return false;
  const double farthest = dot_of_size(g, amplitudes_.data(), n_);
  return farthest < high_[i] && -farthest > low_[i];
}

bool EventFreeHorizon::passes(Level& level, std::size_t i, double before, double after) {
  double& margin = level.margins[i];
  if (margin < 0.0) margin = dot_of_size(functions_.data() + i * n_, level.bounds.data(), n_);
  return std::max(before, after) + margin < high_[i] && std::min(before, after) - margin > low_[i];
}

double EventFreeHorizon::event_free_time(std::size_t index, std::size_t n) {
  Level& level = levels_[index];
  const auto sample = [&](std::size_t i) {
    return dot(functions_.data() + i * n_, level.z.data(), level.n_kept);
  };
  for (const std::size_t i : level.functions) level.values[i] = sample(i);
  Level* finer = index + 1 < n_levels ? &levels_[index + 1] : nullptr;
  for (std::size_t interval = 0; interval < n; ++interval) {
    if (finer) {
      finer->functions.clear();
      finer->z = level.z;
      finer->rates = level.rates;
    }
    for (std::size_t k = 0; k < n_; ++k) {
      const double z = level.z[k];
      const double rate = level.rates[k];
      level.z[k] = level.cosine[k] * z + level.sine_over_omega[k] * rate;
      level.rates[k] = level.minus_omega_sine[k] * z + level.cosine[k] * rate;
    }
    bool all_pass = true;
    const double begun = static_cast<double>(interval) * level.interval;
    for (const std::size_t i : level.functions) {
      const double before = std::exchange(level.values[i], sample(i));
      if (passes(level, i, before, level.values[i])) continue;
      all_pass = false;
      if (!finer) break;
      finer->functions.push_back(i);
    }
    if (!all_pass) {
      const double passed = finer ? event_free_time(index + 1, factor) : 0.0;
      if (passed < level.interval) return begun + passed;
    }
    if (index == 0 && level.values.back() > largest_) {
      largest_ = level.values.back();
      time_of_largest_ = begun + level.interval;
    }
    if (index == 0 && level.values.back() < smallest_) {
      smallest_ = level.values.back();
      time_of_smallest_ = begun + level.interval;
    }
  }
  return static_cast<double>(n) * level.interval;
}

}  // namespace subimpact
