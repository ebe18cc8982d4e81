#include "integrate/nystrom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace subimpact {
namespace {

// Step control: the next step is `safety` of what the estimate allows, changed by limited factors.
constexpr double safety = 0.9;
constexpr double largest_growth = 4.0;
constexpr double largest_cut = 0.2;
constexpr double integral_part = 0.4;
constexpr int most_rejections = 40;
// A step shorter than this part of the time it starts at advances by little but rounding.
constexpr double shortest_step = 16.0 * std::numeric_limits<double>::epsilon();

// The nonzero terms of a row of coefficients.
struct Terms {
  std::array<double, 20> weight;
  std::array<const double*, 20> column;
  std::size_t count = 0;

  Terms(const std::vector<double>& row, std::size_t length,
        const std::vector<AlignedVector>& stages, double factor) {
    for (std::size_t j = 0; j < length; ++j) {
      if (row[j] == 0.0) continue;
      weight[count] = factor * row[j];
      column[count] = stages[j].data();
      ++count;
    }
  }
};

template <std::size_t N>
void sum_up(const double* base, double h, const double* rate, const Terms& terms, double* out,
            std::size_t n) {
  // Copies, which no store to `out` can change.
  std::array<double, N> weight;
  std::array<const double*, N> column;
  std::copy_n(terms.weight.begin(), N, weight.begin());
  std::copy_n(terms.column.begin(), N, column.begin());
#pragma GCC ivdep
  for (std::size_t i = 0; i < n; ++i) {
    double sum = base[i] + h * rate[i];
    for (std::size_t k = 0; k < N; ++k) sum += weight[k] * column[k][i];
    out[i] = sum;
  }
}

// out = base + h rate + sum of terms.
template <std::size_t N = 0>
void combine(const double* base, double h, const double* rate, const Terms& terms, double* out,
             std::size_t n) {
  if constexpr (N <= 17) {
    if (terms.count == N) return sum_up<N>(base, h, rate, terms, out, n);
    return combine<N + 1>(base, h, rate, terms, out, n);
  }
}

template <std::size_t N>
double squares(const Terms& terms, std::size_t n) {
  std::array<double, N> weight;
  std::array<const double*, N> column;
  std::copy_n(terms.weight.begin(), N, weight.begin());
  std::copy_n(terms.column.begin(), N, column.begin());
  Lanes running{};
  std::size_t i = 0;
  for (; i + n_lanes <= n; i += n_lanes) {
    Lanes here{};
    for (std::size_t k = 0; k < N; ++k) here += weight[k] * lanes_at(column[k] + i);
    running += here * here;
  }
  double total = sum(running);
  for (; i < n; ++i) {
    double here = 0.0;
    for (std::size_t k = 0; k < N; ++k) here += weight[k] * column[k][i];
    total += here * here;
  }
  return total;
}

// Sum over the entries of (sum of terms)^2.
template <std::size_t N = 0>
double sum_of_squares(const Terms& terms, std::size_t n) {
  if constexpr (N <= 17) {
    if (terms.count == N) return squares<N>(terms, n);
    return sum_of_squares<N + 1>(terms, n);
  } else {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

Nystrom::Nystrom(SecondOrderOde& ode, const NystromOptions& options)
    : ode_(ode),
      table_(nystrom_table(options.table)),
      first_same_as_last_(table_.first_same_as_last()),
      n_(ode.n_positions()),
      fixed_step_(options.fixed_step),
      max_step_(options.max_step.value_or(std::numeric_limits<double>::infinity())),
      position_weight_(1.0 / (options.relative_tolerance * ode.scales().position)),
      velocity_weight_(1.0 / (options.relative_tolerance * ode.scales().velocity)),
      stages_(table_.n_stages(), Vector(n_)),
      partial_stages_(table_.n_stages(), Vector(n_)),
      end_acceleration_(n_),
      trial_(2 * n_) {
  // A first guess the controller corrects at once: a thousandth of the problem's own time scale.
  next_step_ = fixed_step_.value_or(1e-3 * ode.scales().position / ode.scales().velocity);
}

void Nystrom::accelerate(const double* positions, Vector& result) {
  ode_.acceleration({positions, n_}, result);
  ++work_.right_hand_sides;
}

void Nystrom::restart(double t, const State& y) {
  t0_ = t1_ = t;
  y0_ = y;
  y1_ = y;
  accelerate(y1_.data(), end_acceleration_);
}

void Nystrom::advance(double h, std::vector<Vector>& stages, State& y) {
  const double* q0 = y0_.data();
  const double* v0 = q0 + n_;
  double* q = y.data();
  const std::size_t n_stages = table_.n_stages();
  const std::size_t n_inner = n_stages - (first_same_as_last_ ? 1 : 0);
  for (std::size_t i = 1; i < n_inner; ++i) {
    combine(q0, table_.c[i] * h, v0, Terms(table_.a[i], i, stages, h * h), q, n_);
    accelerate(q, stages[i]);
  }
  combine(q0, h, v0, Terms(table_.position, n_inner, stages, h * h), q, n_);
  if (first_same_as_last_ && &stages == &stages_) accelerate(q, stages.back());
  // The velocity weights of a table that ends on the next step's first stage leave that stage out.
  combine(v0, 0.0, v0, Terms(table_.velocity, n_inner, stages, h), q + n_, n_);
}

double Nystrom::error_norm(double h) const {
  const Terms position(table_.position_error, table_.n_stages(), stages_, h * h * position_weight_);
  const Terms velocity(table_.velocity_error, table_.n_stages(), stages_, h * velocity_weight_);
  const double sum = sum_of_squares(position, n_) + sum_of_squares(velocity, n_);
  return std::sqrt(sum / static_cast<double>(2 * n_));
}

void Nystrom::step() {
  std::swap(y0_, y1_);
  std::swap(stages_.front(), end_acceleration_);
  t0_ = t1_;
  y1_.resize(y0_.size());
  for (int rejections = 0;; ++rejections) {
    const double h = std::min(next_step_, max_step_);
    const bool too_short = !fixed_step_ && !(h > shortest_step * std::abs(t0_));
    if (too_short || rejections > most_rejections) {
      undo_step();
      throw IntegrationFailure(t0_, "nystrom", "step size too small",
                               "the error estimate stays above the tolerance, or is not a number, "
                               "however short the step");
    }
    advance(h, stages_, y1_);
    t1_ = t0_ + h;
    if (fixed_step_) break;
    const double error = error_norm(h);
    const double exponent = 1.0 / (table_.embedded_order + 1.0);
    if (error <= 1.0) {
      const double now = std::max(error, 1e-10);
      const double factor = safety * std::pow(now, -exponent * (1.0 + integral_part)) *
                            std::pow(previous_error_, exponent * integral_part);
      next_step_ = h * std::clamp(factor, largest_cut, rejections > 0 ? 1.0 : largest_growth);
      previous_error_ = now;
      break;
    }
    ++work_.rejected_steps;
    const double factor = std::isfinite(error) ? safety * std::pow(error, -exponent) : largest_cut;
    next_step_ = h * std::max(factor, largest_cut);
  }
  if (first_same_as_last_) {
    std::copy(stages_.back().begin(), stages_.back().end(), end_acceleration_.begin());
  } else {
    accelerate(y1_.data(), end_acceleration_);
  }
  ++work_.steps;
}

void Nystrom::state_at(double t, State& y) {
  y.resize(2 * n_);
  std::swap(partial_stages_.front(), stages_.front());
  advance(t - t0_, partial_stages_, y);
  std::swap(partial_stages_.front(), stages_.front());
  ++work_.partial_steps;
}

}  // namespace subimpact
