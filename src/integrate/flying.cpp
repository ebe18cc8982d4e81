#include "integrate/flying.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace subimpact {
namespace {

// All in steps of the other integrator: between two looks at whether to fly, after flights that
// paid and after those that did not;
constexpr int least_patience = 1;
constexpr int most_patience = 16;
// the outlook from which on a flight is worth the trouble of finding out how far it goes;
constexpr double promising_outlook = 12.0;
// the length below which it is not begun, and below which it did not pay.
constexpr double least_flight = 4.0;
constexpr double paying_flight = 8.0;

}  // namespace

Flying::Flying(std::unique_ptr<Integrator> integrator, std::unique_ptr<FreeFlight> flight,
               double max_step)
    : integrator_(std::move(integrator)),
      flight_(std::move(flight)),
      safe_flight_(*flight_),
      max_step_(max_step),
      omega_(flight_->frequencies()),
      n_(omega_.size()),
      patience_(least_patience),
      z0_(n_),
      rates0_(n_),
      low_(flight_->n_guards()),
      high_(flight_->n_guards()),
      z_(n_),
      rates_(n_) {}

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
  } else if (waited_++ >= patience_ && flight_->outlook(y1_) >= promising_outlook * usual_step_) {
    flight_->enter(y1_, z0_, rates0_, low_, high_);
    const double length = safe_flight_.duration(z0_, rates0_, low_, high_, max_step_);
    patience_ = length >= paying_flight * usual_step_ ? least_patience
                                                      : std::min(2 * patience_, most_patience);
    waited_ = 0;
    if (length >= least_flight * usual_step_ && length > 0.0) {
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
  usual_step_ = t1_ - t0_;
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

}  // namespace subimpact
