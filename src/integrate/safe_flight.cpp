#include "integrate/safe_flight.h"

#include <algorithm>
#include <cmath>

#include "numerics/lanes.h"

namespace subimpact {
namespace {

// Parts of a guard's room, on the average over the guards, that go into the bound on dropped
// oscillators and into what lies between samples, level by level.
struct Share {
  double dropped, between;
};
constexpr std::array<Share, 3> shares{{{0.25, 0.15}, {0.06, 0.08}, {0.01, 0.01}}};
// The last guard's room may vanish; it is taken to be at least this part of the guard's swing.
constexpr double least_swing = 1e-3;
// A guard with less room, in parts of its swing, is in doubt on all but the last level anyway: the
// others are not chosen for it.
constexpr double least_typical_room = 0.3;
// Intervals of the first level in a flight.
constexpr std::size_t most_intervals = 4096;

}  // namespace

SafeFlight::SafeFlight(const FreeFlight& flight)
    : flight_(flight),
      omega_(flight.frequencies()),
      n_(omega_.size()),
      n_uniform_(0),
      longest_interval_(1.0),
      amplitude_(n_),
      bending_(n_),
      share_(n_) {
  while (n_uniform_ < n_ && omega_[n_uniform_] == 0.0) ++n_uniform_;
  if (n_uniform_ < n_) longest_interval_ = 1.0 / omega_[n_uniform_];
  watched_.reserve(flight.n_guards());
  for (Level& level : levels_) {
    for (auto* of_oscillators :
         {&level.cosine, &level.sine_over_omega, &level.minus_omega_sine, &level.z, &level.rates}) {
      of_oscillators->resize(n_);
    }
    level.doubt.resize(flight.n_guards());
    level.values.resize(flight.n_guards());
    level.guards.reserve(flight.n_guards());
    level.in_doubt.reserve(flight.n_guards());
  }
}

double SafeFlight::duration(std::span<const double> z, std::span<const double> rates,
                            std::span<const double> low, std::span<const double> high,
                            double longest) {
  for (std::size_t k = 0; k < n_; ++k) {
    const double w = omega_[k];
    amplitude_[k] = w > 0.0 ? std::sqrt(z[k] * z[k] + rates[k] * rates[k] / (w * w)) : 0.0;
    bending_[k] = w * w * amplitude_[k];
  }
  if (!choose_guards(z, low, high)) return 0.0;
  choose_levels();
  Level& first = levels_.front();
  std::copy(z.begin(), z.end(), first.z.begin());
  std::copy(rates.begin(), rates.end(), first.rates.begin());
  first.guards.resize(watched_.size());
  for (std::size_t i = 0; i < watched_.size(); ++i) first.guards[i] = i;
  const double needed = std::min(std::ceil(longest / first.interval), double{most_intervals});
  return std::min(safe_time(0, static_cast<std::size_t>(needed)), longest);
}

bool SafeFlight::choose_guards(std::span<const double> z, std::span<const double> low,
                               std::span<const double> high) {
  watched_.clear();
  const std::size_t last = flight_.n_guards() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const double* g = flight_.guard(i).data();
    const double swing = dot_of_size(g, amplitude_.data(), n_);
    double room = std::min(high[i], -low[i]);
    if (i == last) {
      room = std::max(high[i] - dot(g, z.data(), n_), least_swing * swing);
    } else if (swing < room) {
      continue;
    }
    if (!(room > 0.0)) return false;
    watched_.push_back({g, low[i], high[i], room, swing});
  }
  return true;
}

void SafeFlight::choose_levels() {
  std::fill(share_.begin(), share_.end(), 0.0);
  for (const Watched& w : watched_) {
    const double factor = 1.0 / std::max(w.room, least_typical_room * w.swing);
    for (std::size_t k = 0; k < n_; ++k) share_[k] += factor * std::abs(w.coefficients[k]);
  }
  const auto n_watched = static_cast<double>(watched_.size());
  // From the finest up.
  std::size_t n_kept = n_;
  double dropped = 0.0;
  double finer_interval = 0.0;
  for (std::size_t l = n_levels; l-- > 0;) {
    while (n_kept > n_uniform_) {
      const double more = share_[n_kept - 1] * amplitude_[n_kept - 1];
      if (dropped + more > shares[l].dropped * n_watched) break;
      dropped += more;
      --n_kept;
    }
    const double bending = dot(share_.data(), bending_.data(), n_kept);
    double interval =
        std::min(std::sqrt(8.0 * shares[l].between * n_watched / bending), longest_interval_);
    if (l + 1 < n_levels) {
      const double parts = std::max(1.0, std::floor(interval / finer_interval));
      levels_[l + 1].n_parts = static_cast<std::size_t>(parts);
      interval = parts * finer_interval;
    }
    set_level(levels_[l], n_kept, interval);
    finer_interval = interval;
  }
}

void SafeFlight::set_level(Level& level, std::size_t n_kept, double interval) {
  level.n_kept = n_kept;
  level.interval = interval;
  std::fill(level.doubt.begin(), level.doubt.end(), -1.0);
  for (std::size_t k = 0; k < levels_.back().n_kept; ++k) {
    const double w = omega_[k];
    level.cosine[k] = std::cos(w * interval);
    level.sine_over_omega[k] = w > 0.0 ? std::sin(w * interval) / w : interval;
    level.minus_omega_sine[k] = -w * w * level.sine_over_omega[k];
  }
}

double SafeFlight::doubt(Level& level, std::size_t i) {
  double& known = level.doubt[i];
  if (known < 0.0) {
    const double* g = watched_[i].coefficients;
    const std::size_t n_kept = level.n_kept;
    known = dot_of_size(g + n_kept, amplitude_.data() + n_kept, n_ - n_kept) +
            level.interval * level.interval / 8.0 * dot_of_size(g, bending_.data(), n_kept);
  }
  return known;
}

double SafeFlight::safe_time(std::size_t index, std::size_t parts) {
  Level& level = levels_[index];
  const std::size_t n_all = levels_.back().n_kept;
  const auto value = [&](std::size_t i) {
    return dot(watched_[i].coefficients, level.z.data(), level.n_kept);
  };
  for (const std::size_t i : level.guards) level.values[i] = value(i);
  for (std::size_t part = 0; part < parts; ++part) {
    if (index + 1 < n_levels) {  // kept for the level below
      Level& below = levels_[index + 1];
      std::copy_n(level.z.begin(), n_all, below.z.begin());
      std::copy_n(level.rates.begin(), n_all, below.rates.begin());
    }
    for (std::size_t k = 0; k < n_all; ++k) {
      const double z = level.z[k];
      const double rate = level.rates[k];
      level.z[k] = level.cosine[k] * z + level.sine_over_omega[k] * rate;
      level.rates[k] = level.minus_omega_sine[k] * z + level.cosine[k] * rate;
    }
    level.in_doubt.clear();
    for (const std::size_t i : level.guards) {
      const Watched& w = watched_[i];
      const double before = level.values[i];
      const double now = value(i);
      level.values[i] = now;
      const double margin = doubt(level, i);
      const bool safe =
          std::max(before, now) + margin < w.high && std::min(before, now) - margin > w.low;
      if (!safe) level.in_doubt.push_back(i);
    }
    if (level.in_doubt.empty()) continue;
    double safe = 0.0;
    if (index + 1 < n_levels) {
      Level& below = levels_[index + 1];
      below.guards = level.in_doubt;
      safe = safe_time(index + 1, below.n_parts);
      if (safe >= level.interval) continue;
    }
    return static_cast<double>(part) * level.interval + safe;
  }
  return static_cast<double>(parts) * level.interval;
}

}  // namespace subimpact
