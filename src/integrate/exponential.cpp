#include "integrate/exponential.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "numerics/gauss.h"
#include "numerics/hermite.h"
#include "numerics/lanes.h"

namespace subimpact {
namespace {

constexpr int deepest_level = 48;
constexpr int most_iterations = 30;
// Newton's method ends when forces change by less than this part of the largest.
constexpr double solved = 1e-13;
// An uncertainty of lambda below this part of the displacements that add up to it is rounding.
constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
// A cubic off by up to d is off by up to 3.1 d in its slope (of s in [0, 1]); rounded up.
constexpr double slope_error_per_error = 4.0;
// Decay rate over frequency from which the two parts of an overdamped motion are taken apart.
constexpr double apart = 2.0;
// The estimate falls by about 2^5 when a step is halved; the step is doubled below half of that.
constexpr double part_for_doubling = 1.0 / 64.0;

}  // namespace

Exponential::Exponential(std::unique_ptr<ForcedOscillators> oscillators,
                         const IntegratorOptions& options)
    : owned_(std::move(oscillators)),
      oscillators_(*owned_),
      options_(options),
      n_(oscillators_.size()),
      scales_(oscillators_.scales()),
      unit_(scales_.position / scales_.velocity),
      per_square_(n_, 0.0),
      response_(n_, 0.0),
      twice_decay_(n_, 0.0) {
  for (std::size_t i = 0; i < n_; ++i) {
    const double w = oscillators_.frequencies()[i];
    if (w > 0.0) per_square_[i] = 1.0 / (w * w);
    response_[i] = per_square_[i] * oscillators_.loads()[i];
    if (!oscillators_.decay_rates().empty()) twice_decay_[i] = 2.0 * oscillators_.decay_rates()[i];
  }
  if (options_.fixed_step) {
    unit_ = *options_.fixed_step;
  } else if (options_.max_step) {
    while (unit_ / std::exp2(first_level_) > *options_.max_step) ++first_level_;
  }
  level_ = options_.fixed_step ? 0 : std::max(first_level_, 4);
}

const OscillatorStep& Exponential::table(int level) {
  auto& entry = tables_[level];
  if (!entry) {
    entry = std::make_unique<OscillatorStep>(oscillators_, std::ldexp(unit_, -level));
    ++work_.factorisations;
  }
  return *entry;
}

void Exponential::restart(double t, const State& y) {
  stand_at(t, y);
  read_end();
  bound_ = -1.0;
}

void Exponential::read_end() {
  lambda1_ = dot(oscillators_.displacements().data(), y1_.data(), n_);
  rate1_ = dot(oscillators_.displacements().data(), y1_.data() + n_, n_);
}

void Exponential::end_step(const OscillatorStep& taken) {
  if (!step_loads_.value.empty()) taken.add_loads(step_loads_, y1_);
  read_end();
  t1_ = t0_ + taken.length();
  force_length_ = taken.length();
}

void Exponential::step() {
  size_ = dot_of_size(oscillators_.displacements().data(), y1_.data(), n_);
  std::swap(y0_, y1_);
  y1_.resize(y0_.size());
  t0_ = t1_;
  if (oscillators_.has_loads()) step_loads_ = oscillators_.loads_from(t0_);
  if (oscillators_.is_free()) {
    free_step();
  } else {
    bound_ = -1.0;
    forced_step();
  }
  ++work_.steps;
}

double Exponential::error_of_cubic(double h) const {
  const auto omega = oscillators_.frequencies();
  const auto c = oscillators_.displacements();
  const auto decay = oscillators_.decay_rates();
  const double h4 = h * h * h * h / 384.0;
  // Error of interpolating e^(-rate t): that is at most 1, its interpolant at most 1 + 8/27 rate h.
  const auto of_decay = [&](double rate) {
    return std::min(h4 * rate * rate * rate * rate, 1.0 + 8.0 / 27.0 * rate * h);
  };
  double sum = 0.0;
  for (std::size_t i = 0; i < n_; ++i) {
    const double w = omega[i];
    double q = y0_[i];
    double v = y0_[n_ + i];
    // About the motion that the loads keep up, of which the fourth derivative is 0.
    if (!step_loads_.value.empty() && w > 0.0) {
      const double rate = step_loads_.rate[i] / (w * w);
      q -= step_loads_.value[i] / (w * w) - (decay.empty() ? 0.0 : 2.0 * decay[i] / (w * w)) * rate;
      v -= rate;
    }
    const double wq = w * q;
    const double amplitude_w = std::sqrt(wq * wq + v * v);  // A omega
    if (decay.empty()) {
      sum += std::abs(c[i]) * h4 * amplitude_w * w * w * w;
    } else if (decay[i] > apart * w) {
      // The two parts, e^(-slow t) and e^(-fast t), each with its own error.
      const double root = std::sqrt((decay[i] - w) * (decay[i] + w));
      const double fast = decay[i] + root;
      const double slow = w * w / fast;
      const double of_slow = std::abs(v + fast * q) * of_decay(slow);
      const double of_fast = std::abs(v + slow * q) * of_decay(fast);
      sum += std::abs(c[i]) * (of_slow + of_fast) / (2.0 * root);
    } else {
      const double rate = decay[i] + std::hypot(w, decay[i]);
      sum += std::abs(c[i]) * h4 * amplitude_w * rate * rate * rate;
    }
  }
  return sum;
}

double Exponential::error_of_swings(const OscillatorStep& step) const {
  const double* const omega = oscillators_.frequencies().data();
  const double* const per_square = per_square_.data();  // 1/omega^2
  const double* const b = response_.data();             // b/omega^2
  const double* const d = twice_decay_.data();
  const double* const q = y0_.data();
  const double* const v = y0_.data() + n_;
  const double h = step.length();
  if (!(h * h * h > 0.0)) return 0.0;
  const std::span<const double> force = force_.coefficients();
  const double f0 = force[0], f1 = force[1] / h, f2 = force[2] / (h * h);
  const double f3 = force[3] / (h * h * h);
  // The answer to force and loads is a cubic, with the derivatives p_k at the start; the rest
  // swings.
  const auto speed_squared = [=](auto at, auto p0, auto p1) {
    const auto swing = at(omega) * (at(q) - p0), speed = at(v) - p1;
    const auto sum = swing * swing + speed * speed;
    return OscillatorStep::is_fast(at(omega), h) ? sum : 0.0 * sum;
  };
  const auto squares = [=](auto at, auto a0, auto a1) {
    const auto per = at(per_square), share = at(b);
    const auto p3 = share * f3;
    const auto p2 = share * f2 - per * at(d) * p3;
    const auto p1 = share * f1 + per * (a1 - at(d) * p2 - p3);
    return speed_squared(at, share * f0 + per * (a0 - at(d) * p1 - p2), p1);
  };
  const double* const a0 = step_loads_.value.data();
  const double* const a1 = step_loads_.rate.data();
  const double sum =
      a0 != nullptr ? sum_of(n_, [=](auto at) { return squares(at, at(a0), at(a1)); })
                    : sum_of(n_, [=](auto at) { return squares(at, 0.0 * at(q), 0.0 * at(q)); });
  return step.error_per_swing() * std::sqrt(sum);
}

bool Exponential::resolves_side(const Ends& ends, double h, double uncertainty) const {
  // The cubic's distance from the critical displacement, at its ends and extrema.
  const double critical = oscillators_.critical_displacement();
  const double sign = oscillators_.is_free() ? 1.0 : -1.0;  // the side on which an event lies
  const HermiteCubic path(sign * (ends.lambda0 - critical), sign * ends.rate0,
                          sign * (ends.lambda1 - critical), sign * ends.rate1, h);
  // A local maximum between two extrema does not show at the ends.
  if (path.reversed_at()) {
    const double maximum = std::max(path(path.extrema().first), path(path.extrema().second));
    if (maximum >= -uncertainty) return false;
  }
  if (uncertainty <= rounding * size_) return true;
  // One certain crossing does not shorten the step: lambda rises throughout, more steeply than the
  // cubic's slope can be wrong, and ends above the uncertainty.
  if (path(1.0) > uncertainty && path.least_slope() > slope_error_per_error * uncertainty)
    return true;
  double nearest = path(1.0);
  if (sign * ends.rate0 > 0.0 && sign * ends.rate1 < 0.0) {
    nearest = std::max(nearest, path(path.peak()));
  }
  return nearest < -uncertainty;
}

void Exponential::free_step() {
  const bool falls = !oscillators_.decay_rates().empty();
  if (bound_ < 0.0 && !falls) bound_ = error_of_cubic(1.0);
  const double lambda0 = lambda1_;
  const double rate0 = rate1_;
  if (!options_.fixed_step) level_ = std::max(level_ - 1, first_level_);
  force_ = ForcePolynomial();
  for (;; ++level_) {
    const OscillatorStep& trial = table(level_);
    const double h = trial.length();
    const double uncertainty = falls ? error_of_cubic(h) : h * h * h * h * bound_;
    trial.advance_freely(y0_, y1_);
    end_step(trial);
    if (options_.fixed_step || level_ >= deepest_level ||
        resolves_side({lambda0, rate0, lambda1_, rate1_}, h, uncertainty)) {
      return;
    }
    ++work_.rejected_steps;
  }
}

bool Exponential::solve(const OscillatorStep& step, const NodeForces& free, NodeForces& forces,
                        NodeForces& lambda) const {
  constexpr std::size_t n = n_force_nodes;
  double largest_before = 0.0;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    std::array<NodeForces, n> jacobian;
    NodeForces change;
    for (std::size_t i = 0; i < n; ++i) {
      lambda[i] = free[i];
      for (std::size_t j = 0; j < n; ++j) lambda[i] += step.compliance(i, j) * forces[j];
      const ForcedOscillators::Force at = oscillators_.force(lambda[i]);
      change[i] = at.value - forces[i];
      for (std::size_t j = 0; j < n; ++j) jacobian[i][j] = -at.slope * step.compliance(i, j);
      jacobian[i][i] += 1.0;
    }
    const Eigen::Map<const Eigen::Matrix<double, n, n, Eigen::RowMajor>> matrix(jacobian[0].data());
    Eigen::Map<Eigen::Vector<double, n>> unknowns(change.data());
    unknowns = matrix.partialPivLu().solve(unknowns).eval();
    double size = 0.0;
    double largest = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      forces[i] += change[i];
      size = std::max(size, std::abs(forces[i]));
      largest = std::max(largest, std::abs(change[i]));
    }
    if (!std::isfinite(largest)) return false;
    // Newton's method squares the error, so two changes predict the next one.
    const double gain = largest_before > 0.0 ? largest / largest_before : 1.0;
    const double next = gain < 0.1 ? largest * gain * gain : largest;
    if (next <= solved * size || largest == 0.0) {
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) lambda[i] += step.compliance(i, j) * change[j];
      }
      return true;
    }
    largest_before = largest;
  }
  return false;
}

void Exponential::forced_step() {
  const double lambda0 = lambda1_;
  const double rate0 = rate1_;
  const ForcedOscillators::Force start = oscillators_.force(lambda0);
  const double tolerance = options_.relative_tolerance * scales_.position;
  for (;; ++level_) {
    if (level_ > deepest_level) {
      undo_step();
      throw IntegrationFailure(t0_, "exponential", "step size too small",
                               "the force does not become smooth on any scale");
    }
    const OscillatorStep& trial = table(level_);
    const double h = trial.length();
    NodeForces free = trial.free_displacements(y0_);
    if (!step_loads_.value.empty()) trial.add_loads(step_loads_, free);
    NodeForces forces;
    for (std::size_t i = 0; i < n_force_nodes; ++i) {
      forces[i] = start.value + start.slope * rate0 * gauss<n_force_nodes>.points[i] * h;
    }
    NodeForces lambda;
    if (solve(trial, free, forces, lambda)) {
      work_.right_hand_sides += n_force_nodes;
      trial.advance(y0_, forces, y1_);
      end_step(trial);
      force_ = ForcePolynomial(forces);
      if (options_.fixed_step) return;
      const double defect = std::max(std::abs(force_(0.0) - start.value),
                                     std::abs(force_(1.0) - oscillators_.force(lambda1_).value));
      const double error = defect * trial.constant_force_compliance();
      double uncertainty = 0.0;
      const HermiteCubic path(lambda0, rate0, lambda1_, rate1_, h);
      for (std::size_t i = 0; i < n_force_nodes; ++i) {
        uncertainty =
            std::max(uncertainty, std::abs(path(gauss<n_force_nodes>.points[i]) - lambda[i]));
      }
      const Ends ends{lambda0, rate0, lambda1_, rate1_};
      if (error <= tolerance && resolves_side(ends, h, 2.0 * uncertainty) &&
          (trial.error_per_swing() == 0.0 ||
           resolves_side(ends, h, 2.0 * uncertainty + error_of_swings(trial)))) {
        if (error <= part_for_doubling * tolerance) level_ = std::max(level_ - 1, first_level_);
        return;
      }
    } else if (options_.fixed_step) {
      undo_step();
      throw IntegrationFailure(t0_, "exponential", "no convergence",
                               "the collocation equations have no solution at this solver.step");
    }
    ++work_.rejected_steps;
  }
}

bool Exponential::integrate_squared_velocities(double t, std::span<double> result) {
  if (oscillators_.decay_rates().empty() || oscillators_.has_loads()) return false;
  subimpact::integrate_squared_velocities(oscillators_, y0_, force_, force_length_, t - t0_,
                                          result);
  return true;
}

void Exponential::state_at(double t, State& y) {
  y.resize(2 * n_);
  flow(oscillators_, y0_, force_, force_length_, t - t0_, y);
  add_response(oscillators_, step_loads_, t - t0_, y);
  ++work_.partial_steps;
}

}  // namespace subimpact
