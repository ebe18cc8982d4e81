#include "integrate/sundials/solver_frame.h"

#include <cmath>
#include <cstdlib>
#include <limits>

#include "numerics/lanes.h"

namespace subimpact {
namespace {

#if SUNDIALS_VERSION_MAJOR >= 7
void keep_context_message(int, const char*, const char*, const char* text, SUNErrCode,
                          void* message, SUNContext) {
  *static_cast<std::string*>(message) = text ? text : "";
}
#endif

constexpr double roundings = 100.0;  // of a number, that a step may be off by

// A value without a root.
constexpr double negative = -1.0;

// Far below the rounding of functions of order one. The library finds a change of sign by the
// product of two values, which must not underflow: its search would not end. Nor does it end where
// values overflow or are no numbers, as in a step that blew up.
constexpr double smallest = 1e-100;
constexpr double largest = 1e100;

double searchable(double value) {
  if (std::isnan(value)) return negative;
  if (std::abs(value) < smallest) return -smallest;
  return std::clamp(value, -largest, largest);
}

}  // namespace

SolverFrame::SolverFrame(SecondOrderOde& ode, const IntegratorOptions& options,
                         const LibraryCalls& calls, ContextPointer context)
    : ode_(ode),
      n_positions_(ode.n_positions()),
      calls_(calls),
      functions_(options.event_functions),
      context_(std::move(context)),
      y_(make_vector(2 * n_positions_, context_.get(), options.vector_operations)),
      memory_(nullptr, {calls.free}),
      position_weight_(1.0 / (options.relative_tolerance * ode.scales().position)),
      velocity_weight_(1.0 / (options.relative_tolerance * ode.scales().velocity)) {
  N_VConst(0.0, y_.get());
#if SUNDIALS_VERSION_MAJOR >= 7
  SUNContext_PushErrHandler(context_.get(), keep_context_message, &message_);
#endif
}

void SolverFrame::own(void* memory) {
  if (!memory)
    throw IntegrationFailure(0.0, calls_.prefix + std::string("Create"), "no memory", "");
  memory_.reset(memory);
  check(calls_.set_user_data(memory, this), "SetUserData");
#if SUNDIALS_VERSION_MAJOR < 7
  check(calls_.set_message_handler(memory, keep_message, this), "SetErrHandlerFn");
#endif
}

void SolverFrame::set_step_control(const IntegratorOptions& options) {
  check(calls_.set_weights(memory(), error_weights), "WFtolerances");
  check(calls_.set_max_num_steps(memory(), -1), "SetMaxNumSteps");
  if (options.max_step) check(calls_.set_max_step(memory(), *options.max_step), "SetMaxStep");
}

void SolverFrame::reset(double t, const State& y) {
  std::copy(y.begin(), y.end(), entries(vector()).begin());
  check(calls_.restart(memory(), t, vector()), calls_.restart_name);
  check(restart_roots(y), "RootInit");
  time_ = t;
}

void SolverFrame::limit_first_step(double longest) {
  sunrealtype next = 0.0;
  check(calls_.get_next_step(memory(), &next), "GetCurrentStep");
  if (next > longest) check(calls_.set_first_step(memory(), longest), "SetInitStep");
}

int SolverFrame::evolve(double& reached) {
  // Only the sign of the output time relative to the present time matters.
  return calls_.evolve(memory(), time_ + std::max(1.0, 2.0 * time_), vector(), &reached,
                       calls_.one_step);
}

double SolverFrame::step() {
  double reached = time_;
  int flag = 0;
  root_ = std::exchange(root_at_restart_, std::nullopt);
  if (!root_) {
    flag = evolve(reached);
    while (flag == calls_.root_return && !find_event() && !is_at_end(reached)) {
      flag = evolve(reached);  // the rest of the step
    }
    if (finds_roots() && flag >= 0 && !root_) root_ = risen_function(entries(vector()));
  }
  check(flag, calls_.evolve_name);
  return time_ = reached;
}

void SolverFrame::drain_root() {
  double reached = time_;
  if (!root_ || is_at_end(reached)) return;
  is_silent_ = true;
  evolve(reached);
  is_silent_ = false;
}

int SolverFrame::restart_roots(std::span<const double> y) {
  if (!finds_roots()) return 0;
  const std::size_t n = functions_->size();
  values_.resize(n);
  root_.reset();
  root_at_restart_ = risen_function(y);
  root_flags_.assign(2 * n, 1);
  // The library keeps what it stored of functions whose number does not change.
  int flag = calls_.init_roots(memory(), 0, nullptr);
  if (flag != 0 || n == 0) return flag;
  flag = calls_.init_roots(memory(), static_cast<int>(2 * n), event_values);
  if (flag == 0) flag = calls_.set_root_directions(memory(), root_flags_.data());
  if (flag == 0) flag = calls_.set_no_root_warning(memory());
  return flag;
}

std::optional<Integrator::Root> SolverFrame::risen_function(std::span<const double> y) {
  functions_->evaluate(y, values_);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const auto [value, rate] = values_[i];
    if (value > 0.0 && !(rate <= 0.0)) return Integrator::Root{i, 0.0};
  }
  return std::nullopt;
}

bool SolverFrame::find_event() {
  calls_.get_roots(memory(), root_flags_.data());
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (root_flags_[i] == 0) continue;
    root_ = Integrator::Root{i, root_tolerance()};
    return true;
  }
  return false;
}

double SolverFrame::root_tolerance() const {
  sunrealtype time = 0.0, step = 0.0;
  calls_.get_current_time(memory(), &time);
  calls_.get_last_step(memory(), &step);
  return 100.0 * std::numeric_limits<double>::epsilon() * (std::abs(time) + std::abs(step));
}

bool SolverFrame::is_at_end(double reached) const {
  sunrealtype time = 0.0;
  calls_.get_current_time(memory(), &time);
  return std::abs(time - reached) <= root_tolerance();
}

void SolverFrame::read(State& y) {
  const auto values = entries(vector());
  y.assign(values.begin(), values.end());
}

void SolverFrame::add_counts(WorkCounts& counts) const {
  long rejected = 0, iterations = 0, failures = 0;
  calls_.get_rejected_steps(memory(), &rejected);
  if (calls_.get_nonlinear_stats) {
    calls_.get_nonlinear_stats(memory(), &iterations, &failures);
  }
  counts.rejected_steps += rejected;
  counts.nonlinear_iterations += iterations;
  counts.nonlinear_failures += failures;
  counts.right_hand_sides += right_hand_sides_;
}

int SolverFrame::rate(sunrealtype t, N_Vector y, N_Vector rate, void* frame) {
  SolverFrame& self = of(frame);
  return self.write_rate(t, y, rate, [&self](std::span<const double> in, auto out) {
    self.ode_.acceleration_at(in, out);
  });
}

// Weights 1/(rtol * scale) of positions and velocities, evaluated at every step; lower where
// rounding of what is far from zero (a beam that has moved away) leaves no more.
int SolverFrame::error_weights(N_Vector y, N_Vector weights, void* frame) {
  const SolverFrame& self = of(frame);
  const auto fill = [&](std::span<const double> values, std::span<double> out, double weight) {
    const std::size_t n = values.size();
    const double rms = std::sqrt(dot(values.data(), values.data(), n) / static_cast<double>(n));
    const double rounding = roundings * std::numeric_limits<double>::epsilon() * rms;
    std::ranges::fill(out, std::min(weight, 1.0 / rounding));
  };
  const std::size_t n = self.n_positions_;
  const auto at = entries(y), out = entries(weights);
  fill(at.first(n), out.first(n), self.position_weight_);
  fill(at.subspan(n), out.subspan(n), self.velocity_weight_);
  return 0;
}

int SolverFrame::event_values(sunrealtype, N_Vector y, sunrealtype* result, void* frame) {
  SolverFrame& self = of(frame);
  const std::size_t n = self.values_.size();
  if (self.is_silent_) {
    std::fill_n(result, 2 * n, negative);
    return 0;
  }
  return self.guarded([&] {
    self.functions_->evaluate(entries(y), self.values_);
    for (std::size_t i = 0; i < n; ++i) {
      const auto [value, rate] = self.values_[i];
      result[i] = searchable(value);
      result[n + i] = searchable(-rate);
    }
  });
}

#if SUNDIALS_VERSION_MAJOR < 7
void SolverFrame::keep_message(int code, const char*, const char*, char* message, void* frame) {
  if (code < 0) of(frame).message_ = message;
}
#endif

void SolverFrame::check(int flag, const char* function) {
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  if (flag >= 0) return;
  char* name = calls_.flag_name(flag);
  const std::string copy = name ? name : std::to_string(flag);
  std::free(name);
  throw IntegrationFailure(time_, calls_.prefix + std::string(function), copy, message_);
}

}  // namespace subimpact
