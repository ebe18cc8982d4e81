#include "integrate/nystrom.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "numerics/vector_sum.h"

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

// Adds factor * sum_j row[j] stages[j] over the first `length` stages.
void add_stages(VectorSum& sum, const std::vector<double>& row, std::size_t length,
                const std::vector<AlignedVector>& stages, double factor) {
  assert(row.size() >= length && stages.size() >= length);
  for (std::size_t j = 0; j < length; ++j) sum.add(factor * row[j], stages[j].data());
}

}  // namespace

Nystrom::Nystrom(SecondOrderOde& ode, const IntegratorOptions& options)
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
      end_acceleration_(n_) {
  // A first guess the controller corrects at once: a thousandth of the problem's own time scale.
  next_step_ = fixed_step_.value_or(1e-3 * ode.scales().position / ode.scales().velocity);
}

void Nystrom::accelerate(const double* positions, Vector& result) {
  ode_.acceleration({positions, n_}, result);
  ++work_.right_hand_sides;
}

void Nystrom::restart(double t, const State& y) {
  stand_at(t, y);
  accelerate(y1_.data(), end_acceleration_);
}

void Nystrom::advance(double h, std::vector<Vector>& stages, State& y) {
  const double* q0 = y0_.data();
  const double* v0 = q0 + n_;
  double* q = y.data();
  // q0 + time v0 + h^2 sum_j row[j] k_j
  const auto write_position = [&](double time, const std::vector<double>& row, std::size_t length) {
    VectorSum position;
    position.add(1.0, q0);
    position.add(time, v0);
    add_stages(position, row, length, stages, h * h);
    position.write(q, n_);
  };
  const std::size_t n_inner = table_.n_stages() - (first_same_as_last_ ? 1 : 0);
  for (std::size_t i = 1; i < n_inner; ++i) {
    write_position(table_.c[i] * h, table_.a[i], i);
    accelerate(q, stages[i]);
  }
  write_position(h, table_.position, n_inner);
  if (first_same_as_last_ && &stages == &stages_) accelerate(q, stages.back());
  // The velocity weights of a table that ends on the next step's first stage leave that stage out.
  VectorSum velocity;
  velocity.add(1.0, v0);
  add_stages(velocity, table_.velocity, n_inner, stages, h);
  velocity.write(q + n_, n_);
}

double Nystrom::error_norm(double h) const {
  const std::size_t n_stages = table_.n_stages();
  VectorSum position, velocity;
  add_stages(position, table_.position_error, n_stages, stages_, h * h * position_weight_);
  add_stages(velocity, table_.velocity_error, n_stages, stages_, h * velocity_weight_);
  const double sum = position.sum_of_squares(n_) + velocity.sum_of_squares(n_);
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
