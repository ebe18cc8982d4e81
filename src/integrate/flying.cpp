#include "integrate/flying.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace subimpact {
namespace {

// Parts of a guard's room that may go into the bound on dropped oscillators, and into what lies
// between samples.
constexpr double dropped_share = 0.02;
constexpr double interval_share = 0.02;
// The last guard's room may vanish; it is taken to be at least this part of the guard's swing.
constexpr double least_swing = 1e-3;
constexpr std::size_t batch = 32;
constexpr std::size_t most_batches = 512;

constexpr int least_patience = 16;  // steps
constexpr int most_patience = 256;
// A flight shorter than this many steps of the other integrator is not begun, or did not pay.
constexpr double least_flight = 4.0;
constexpr double paying_flight = 32.0;

}  // namespace

Flying::Flying(std::unique_ptr<Integrator> integrator, std::unique_ptr<FreeFlight> flight,
               double max_step)
    : integrator_(std::move(integrator)),
      flight_(std::move(flight)),
      max_step_(max_step),
      omega_(flight_->frequencies()),
      n_(omega_.size()),
      patience_(least_patience),
      z0_(n_),
      rates0_(n_),
      low_(flight_->n_guards()),
      high_(flight_->n_guards()),
      amplitude_(n_),
      z_(n_),
      rates_(n_) {
  for (const double w : omega_) {
    if (w > 0.0) longest_interval_ = std::max(longest_interval_, 1.0 / w);
  }
  if (longest_interval_ == 0.0) longest_interval_ = 1.0;
}

void Flying::restart(double t, const State& y) {
  t0_ = t1_ = t;
  y0_ = y;
  y1_ = y;
  integrator_->restart(t, y);
  follows_ = true;
  flown_ = false;
}

void Flying::step() {
  if (!flight_->possible()) {
    waited_ = 0;
  } else if (waited_++ >= patience_) {
    const double usual = integrator_->time() - integrator_->start_time();
    const double length = fly();
    patience_ =
        length >= paying_flight * usual ? least_patience : std::min(2 * patience_, most_patience);
    waited_ = 0;
    if (length >= least_flight * usual && length > 0.0) {
      std::swap(y0_, y1_);
      t0_ = t1_;
      t1_ += length;
      move(length);
      flight_->leave(z_, rates_, y1_);
      flown_ = true;
      follows_ = false;
      ++flights_;
      return;
    }
  }
  if (!follows_) integrator_->restart(t1_, y1_);
  follows_ = true;
  integrator_->step();
  flown_ = false;
  std::swap(y0_, y1_);
  t0_ = t1_;
  y1_ = integrator_->state();
  t1_ = integrator_->time();
}

void Flying::state_at(double t, State& y) {
  if (!flown_) return integrator_->state_at(t, y);
  move(t - t0_);
  flight_->leave(z_, rates_, y);
}

WorkCounts Flying::work() const {
  WorkCounts counts = integrator_->work();
  counts.steps += flights_;
  return counts;
}

void Flying::move(double t) {
  for (std::size_t k = 0; k < n_; ++k) {
    const double w = omega_[k];
    const double c = std::cos(w * t);
    const double s = w > 0.0 ? std::sin(w * t) / w : t;
    z_[k] = c * z0_[k] + s * rates0_[k];
    rates_[k] = -w * w * s * z0_[k] + c * rates0_[k];
  }
}

double Flying::fly() {
  flight_->enter(y1_, z0_, rates0_, low_, high_);
  for (std::size_t k = 0; k < n_; ++k) {
    amplitude_[k] = omega_[k] > 0.0 ? std::hypot(z0_[k], rates0_[k] / omega_[k]) : 0.0;
  }
  if (!choose_guards()) return 0.0;
  choose_oscillators();
  return std::min(sample(), max_step_);
}

bool Flying::choose_guards() {
  watched_.clear();
  const std::size_t last = flight_->n_guards() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const double* g = flight_->guard(i).data();
    double swing = 0.0;
    for (std::size_t k = 0; k < n_; ++k) swing += std::abs(g[k]) * amplitude_[k];
    double room = std::min(high_[i], -low_[i]);
    if (i == last) {
      double now = 0.0;
      for (std::size_t k = 0; k < n_; ++k) now += g[k] * z0_[k];
      room = std::max(high_[i] - now, least_swing * swing);
    } else if (swing < room) {
      continue;
    }
    if (!(room > 0.0)) return false;
    watched_.push_back({i, low_[i], high_[i], room, 0.0, 0.0});
  }
  return true;
}

void Flying::choose_oscillators() {
  // From the highest down, as many as every watched guard can spare.
  kept_.clear();
  std::size_t first_dropped = n_;
  const auto can_drop = [&](std::size_t k) {
    if (omega_[k] == 0.0) return true;  // passed over: kept below
    for (const Watched& w : watched_) {
      const double share = std::abs(flight_->guard(w.guard)[k]) * amplitude_[k];
      if (w.dropped + share > dropped_share * w.room) return false;
    }
    return true;
  };
  while (first_dropped > 0 && can_drop(first_dropped - 1)) {
    --first_dropped;
    for (Watched& w : watched_) {
      w.dropped += std::abs(flight_->guard(w.guard)[first_dropped]) * amplitude_[first_dropped];
    }
  }
  for (std::size_t k = 0; k < n_; ++k) {
    if (k < first_dropped || omega_[k] == 0.0) kept_.push_back(k);
  }
  rows_.resize(watched_.size() * kept_.size());
  double* row = rows_.data();
  double shortest = longest_interval_ * longest_interval_;
  for (Watched& w : watched_) {
    const auto g = flight_->guard(w.guard);
    for (const std::size_t k : kept_) {
      *row++ = g[k];
      w.curvature += std::abs(g[k]) * amplitude_[k] * omega_[k] * omega_[k];
    }
    shortest = std::min(shortest, 8.0 * interval_share * w.room / w.curvature);
  }
  interval_ = std::sqrt(shortest);
}

double Flying::sample() {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const std::size_t n_kept = kept_.size();
  const std::size_t n_watched = watched_.size();
  const double tau = interval_;
  for (auto* column : {&cosine_, &sine_over_omega_, &minus_omega_sine_}) column->resize(n_kept);
  samples_.resize(n_kept * (batch + 1));
  values_.resize(n_watched * (batch + 1));
  for (std::size_t j = 0; j < n_kept; ++j) {
    const double w = omega_[kept_[j]];
    cosine_[j] = std::cos(w * tau);
    sine_over_omega_[j] = w > 0.0 ? std::sin(w * tau) / w : tau;
    minus_omega_sine_[j] = -w * w * sine_over_omega_[j];
    samples_[j] = z0_[kept_[j]];
    rates_[j] = rates0_[kept_[j]];
  }
  const auto index = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
  const Eigen::Map<const RowMajor> rows(rows_.data(), index(n_watched), index(n_kept));
  const Eigen::Map<const Eigen::MatrixXd> samples(samples_.data(), index(n_kept), batch + 1);
  Eigen::Map<Eigen::MatrixXd> values(values_.data(), index(n_watched), batch + 1);
  std::size_t intervals = 0;  // shown to be safe
  for (std::size_t b = 0; b < most_batches; ++b) {
    // The first sample of a batch is the last of the one before.
    for (std::size_t m = 0; m < batch; ++m) {
      const double* from = samples_.data() + m * n_kept;
      double* to = samples_.data() + (m + 1) * n_kept;
#pragma GCC ivdep
      for (std::size_t j = 0; j < n_kept; ++j) {
        to[j] = cosine_[j] * from[j] + sine_over_omega_[j] * rates_[j];
        rates_[j] = minus_omega_sine_[j] * from[j] + cosine_[j] * rates_[j];
      }
    }
    values.noalias() = rows * samples;
    for (std::size_t m = 0; m < batch; ++m) {
      const double* here = values_.data() + m * n_watched;
      const double* next = here + n_watched;
      for (std::size_t i = 0; i < n_watched; ++i) {
        const Watched& w = watched_[i];
        const double doubt = w.dropped + tau * tau / 8.0 * w.curvature;
        if (!(std::max(here[i], next[i]) + doubt < w.high &&
              std::min(here[i], next[i]) - doubt > w.low)) {
          return static_cast<double>(intervals) * tau;
        }
      }
      ++intervals;
    }
    std::copy_n(samples_.end() - static_cast<std::ptrdiff_t>(n_kept), n_kept, samples_.begin());
  }
  return static_cast<double>(intervals) * tau;
}

}  // namespace subimpact
