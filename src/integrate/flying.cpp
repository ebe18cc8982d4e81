#include "integrate/flying.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "model/lanes.h"

namespace subimpact {
namespace {

// Parts of a guard's room that may go into the bound on dropped oscillators, and into what lies
// between samples.
constexpr double dropped_share = 0.02;
constexpr double interval_share = 0.02;
// The last guard's room may vanish; it is taken to be at least this part of the guard's swing.
constexpr double least_swing = 1e-3;
// Guards far from their limits are looked at once in so many intervals.
constexpr std::size_t n_fine = 4;
constexpr std::size_t batch = 16;
constexpr std::size_t most_batches = 256;

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

void Flying::Rotation::set(std::span<const double> omega, const std::vector<std::size_t>& kept,
                           double time) {
  cosine.resize(kept.size());
  sine_over_omega.resize(kept.size());
  minus_omega_sine.resize(kept.size());
  for (std::size_t j = 0; j < kept.size(); ++j) {
    const double w = omega[kept[j]];
    cosine[j] = std::cos(w * time);
    sine_over_omega[j] = w > 0.0 ? std::sin(w * time) / w : time;
    minus_omega_sine[j] = -w * w * sine_over_omega[j];
  }
}

void Flying::Rotation::apply(const double* z, const double* rates, double* to,
                             double* rates_to) const {
  const double* c = cosine.data();
  const double* so = sine_over_omega.data();
  const double* os = minus_omega_sine.data();
#pragma GCC ivdep
  for (std::size_t j = 0; j < cosine.size(); ++j) {
    const double q = z[j];
    const double v = rates[j];
    to[j] = c[j] * q + so[j] * v;
    rates_to[j] = os[j] * q + c[j] * v;
  }
}

double Flying::sample() {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const std::size_t n_kept = kept_.size();
  const std::size_t n_watched = watched_.size();
  fine_.set(omega_, kept_, interval_);
  coarse_.set(omega_, kept_, static_cast<double>(n_fine) * interval_);
  samples_.resize(n_kept * (batch + 1));
  sample_rates_.resize(n_kept * (batch + 1));
  values_.resize(n_watched * (batch + 1));
  for (std::size_t j = 0; j < n_kept; ++j) {
    samples_[j] = z0_[kept_[j]];
    sample_rates_[j] = rates0_[kept_[j]];
  }
  const auto index = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
  const Eigen::Map<const RowMajor> rows(rows_.data(), index(n_watched), index(n_kept));
  const Eigen::Map<const Eigen::MatrixXd> samples(samples_.data(), index(n_kept), batch + 1);
  Eigen::Map<Eigen::MatrixXd> values(values_.data(), index(n_watched), batch + 1);
  std::size_t safe = 0;  // fine intervals
  for (std::size_t b = 0; b < most_batches; ++b) {
    // The first sample of a batch is the last of the one before.
    for (std::size_t m = 0; m < batch; ++m) {
      const std::size_t at = m * n_kept;
      coarse_.apply(&samples_[at], &sample_rates_[at], &samples_[at + n_kept],
                    &sample_rates_[at + n_kept]);
    }
    values.noalias() = rows * samples;
    for (std::size_t m = 0; m < batch; ++m) {
      const std::size_t more = safe_intervals(m);
      safe += more;
      if (more < n_fine) return static_cast<double>(safe) * interval_;
    }
    std::copy_n(samples_.end() - static_cast<std::ptrdiff_t>(n_kept), n_kept, samples_.begin());
    std::copy_n(sample_rates_.end() - static_cast<std::ptrdiff_t>(n_kept), n_kept,
                sample_rates_.begin());
  }
  return static_cast<double>(safe) * interval_;
}

std::size_t Flying::safe_intervals(std::size_t m) {
  const double* start = values_.data() + m * watched_.size();
  const double* end = start + watched_.size();
  const auto doubt = [](const Watched& w, double interval) {
    return w.dropped + interval * interval / 8.0 * w.curvature;
  };
  const auto is_safe = [](const Watched& w, double a, double b, double doubt) {
    return std::max(a, b) + doubt < w.high && std::min(a, b) - doubt > w.low;
  };
  in_doubt_.clear();
  const double coarse = static_cast<double>(n_fine) * interval_;
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const Watched& w = watched_[i];
    if (!is_safe(w, start[i], end[i], doubt(w, coarse))) in_doubt_.push_back(i);
  }
  if (in_doubt_.empty()) return n_fine;
  // Between the coarse samples, for those in doubt alone.
  const std::size_t n_kept = kept_.size();
  std::copy_n(&samples_[m * n_kept], n_kept, z_.begin());
  std::copy_n(&sample_rates_[m * n_kept], n_kept, rates_.begin());
  before_.resize(watched_.size());
  for (const std::size_t i : in_doubt_) before_[i] = start[i];
  for (std::size_t f = 0; f < n_fine; ++f) {
    fine_.apply(z_.data(), rates_.data(), z_.data(), rates_.data());
    for (const std::size_t i : in_doubt_) {
      const Watched& w = watched_[i];
      const double here = dot(&rows_[i * n_kept], z_.data(), n_kept);
      if (!is_safe(w, before_[i], here, doubt(w, interval_))) return f;
      before_[i] = here;
    }
  }
  return n_fine;
}

}  // namespace subimpact
