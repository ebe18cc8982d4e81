#include "integrate/sundials/solver_frame.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "integrate/sundials/vector.h"

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
                         const RootCalls& calls, [[maybe_unused]] SUNContext context)
    : ode_(ode),
      n_positions_(ode.n_positions()),
      roots_(options.event_functions, calls),
      position_weight_(1.0 / (options.relative_tolerance * ode.scales().position)),
      velocity_weight_(1.0 / (options.relative_tolerance * ode.scales().velocity)) {
#if SUNDIALS_VERSION_MAJOR >= 7
  SUNContext_PushErrHandler(context, keep_context_message, &message_);
#endif
}

int SolverFrame::rate(double, N_Vector y, N_Vector rate, void* frame) {
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

void SolverFrame::check(int flag, const char* function, char* (*flag_name)(long int)) {
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  if (flag >= 0) return;
  char* name = flag_name(flag);
  const std::string copy = name ? name : std::to_string(flag);
  std::free(name);
  throw IntegrationFailure(time_, function, copy, message_);
}

double time_ahead(double t) { return t + std::max(1.0, 2.0 * t); }

}  // namespace subimpact
