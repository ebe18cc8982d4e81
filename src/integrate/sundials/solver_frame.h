#pragma once

#include <sundials/sundials_context.h>
#include <sundials/sundials_nvector.h>
#include <sundials/sundials_version.h>

#include <cstddef>
#include <exception>
#include <string>

#include "integrate/options.h"
#include "integrate/sundials/root_finder.h"
#include "ode/integrator.h"

namespace subimpact {

/// What the C callbacks of every SUNDIALS solver here need; each solver's user data is its frame.
///
/// No exception crosses a C frame: an exception from a callback is stored, the library is stopped
/// by a return value, and the exception is rethrown unchanged after the call. The library's own
/// messages are kept for the failure that follows them.
class SolverFrame {
 public:
  SolverFrame(SecondOrderOde& ode, const IntegratorOptions& options, const RootCalls& calls,
              SUNContext context);
  SolverFrame(const SolverFrame&) = delete;
  SolverFrame& operator=(const SolverFrame&) = delete;

  /// y' = [v, a(q, v)] of y = [q, v].
  static int rate(double t, N_Vector y, N_Vector rate, void* frame);
  /// Error weights 1/(rtol * scale) of positions and velocities: evaluated at every step, but
  /// constant.
  static int error_weights(N_Vector y, N_Vector weights, void* frame);
  /// The functions whose roots the library finds.
  static int event_values(sunrealtype t, N_Vector y, sunrealtype* values, void* frame);

#if SUNDIALS_VERSION_MAJOR < 7
  static void keep_message(int code, const char* module, const char* function, char* message,
                           void* frame);
#endif

 protected:
  ~SolverFrame() = default;

  static SolverFrame& of(void* user_data) { return *static_cast<SolverFrame*>(user_data); }
  void* user_data() { return this; }

  /// Runs a callback's body: 0, or -1 if it threw.
  template <class Body>
  int guarded(Body body) noexcept {
    try {
      body();
    } catch (...) {
      thrown_ = std::current_exception();
      return -1;
    }
    return 0;
  }
  /// Throws what a callback threw; otherwise IntegrationFailure if `flag` reports one. `flag_name`
  /// is the library's.
  void check(int flag, const char* function, char* (*flag_name)(long int));

  SecondOrderOde& ode_;
  std::size_t n_positions_;
  double time_ = 0.0;  // s, up to which the solution is good
  long right_hand_sides_ = 0;
  RootFinder roots_;

 private:
  double position_weight_, velocity_weight_;
  std::exception_ptr thrown_;
  std::string message_;
};

/// An output time for one-step modes, where only its sign relative to the present time matters.
double time_ahead(double t);

}  // namespace subimpact
