#include "integrate/sundials/solver_frame.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace subimpact {
namespace {

#if SUNDIALS_VERSION_MAJOR >= 7
void keep_context_message(int, const char*, const char*, const char* text, SUNErrCode,
                          void* message, SUNContext) {
  *static_cast<std::string*>(message) = text ? text : "";
}
#endif

}  // namespace

SolverFrame::SolverFrame(SecondOrderOde& ode, const IntegratorOptions& options,
                         const LibraryCalls& calls, ContextPointer context)
    : ode_(ode),
      n_positions_(ode.n_positions()),
      roots_(options.event_functions, calls.roots),
      calls_(calls),
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
  check(calls_.set_user_data(memory, user_data()), "SetUserData");
#if SUNDIALS_VERSION_MAJOR < 7
  check(calls_.set_message_handler(memory, keep_message, user_data()), "SetErrHandlerFn");
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
  check(roots_.restart(memory(), event_values, y), "RootInit");
  time_ = t;
}

int SolverFrame::evolve(double& reached) {
  // Of the output time only the sign relative to the present time matters.
  return calls_.evolve(memory(), time_ + std::max(1.0, 2.0 * time_), vector(), &reached,
                       calls_.one_step);
}

double SolverFrame::step() {
  double reached = time_;
  check(roots_.step(memory(), reached, entries(vector()), [&] { return evolve(reached); }),
        calls_.evolve_name);
  return time_ = reached;
}

void SolverFrame::read(State& y) const {
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

int SolverFrame::rate(sunrealtype, N_Vector y, N_Vector rate, void* frame) {
  SolverFrame& self = of(frame);
  const std::size_t n = self.n_positions_;
  const auto in = entries(y);
  const auto out = entries(rate);
  ++self.right_hand_sides_;
  return self.guarded([&] {
    std::copy_n(in.begin() + static_cast<std::ptrdiff_t>(n), n, out.begin());
    self.ode_.acceleration_at(in, out.subspan(n));
  });
}

// Weights 1/(rtol * scale) of positions and velocities: evaluated at every step, but constant.
int SolverFrame::error_weights(N_Vector, N_Vector weights, void* frame) {
  const SolverFrame& self = of(frame);
  const auto out = entries(weights);
  if (out.front() == self.position_weight_ && out.back() == self.velocity_weight_) return 0;
  const auto middle = out.begin() + static_cast<std::ptrdiff_t>(self.n_positions_);
  std::fill(out.begin(), middle, self.position_weight_);
  std::fill(middle, out.end(), self.velocity_weight_);
  return 0;
}

int SolverFrame::event_values(sunrealtype, N_Vector y, sunrealtype* values, void* frame) {
  SolverFrame& self = of(frame);
  return self.guarded([&] { self.roots_.evaluate(entries(y), values); });
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
