#pragma once

#include <sundials/sundials_version.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "integrate/sundials/linear_algebra.h"

namespace subimpact {

/// The calls that ERKStep, ARKStep and CVODE have in common. Their names begin with `prefix`.
struct LibraryCalls {
  int (*restart)(void*, sunrealtype, N_Vector);
  int (*evolve)(void*, sunrealtype, N_Vector, sunrealtype*, int);
  const char *prefix, *restart_name, *evolve_name;
  int one_step;                                     ///< mode of evolve
  int (*get_nonlinear_stats)(void*, long*, long*);  ///< none of an explicit method
  char* (*flag_name)(long);
  void (*free)(void**);
  int (*set_user_data)(void*, void*);
  int (*set_weights)(void*, int (*)(N_Vector, N_Vector, void*));
  int (*set_max_num_steps)(void*, long);
  int (*set_max_step)(void*, sunrealtype);
  int (*get_rejected_steps)(void*, long*);
  int root_return;  ///< flag of a step that stopped at a root
  int (*init_roots)(void*, int, int (*)(sunrealtype, N_Vector, sunrealtype*, void*));
  int (*set_root_directions)(void*, int*);
  int (*set_no_root_warning)(void*);
  int (*get_roots)(void*, int*);
  int (*get_current_time)(void*, sunrealtype*);
  int (*get_last_step)(void*, sunrealtype*);
  int (*get_next_step)(void*, sunrealtype*);
  int (*set_first_step)(void*, sunrealtype);
#if SUNDIALS_VERSION_MAJOR < 7
  int (*set_message_handler)(void*, void (*)(int, const char*, const char*, char*, void*), void*);
#endif
};

#if SUNDIALS_VERSION_MAJOR < 7
#define SUBIMPACT_MESSAGE_HANDLER(prefix) , prefix##SetErrHandlerFn
#else
#define SUBIMPACT_MESSAGE_HANDLER(prefix)
#endif
/// The calls with one prefix; `family` is that of the library's constants.
#define SUBIMPACT_LIBRARY_CALLS(prefix, family, restart, evolve, get_nonlinear_stats)      \
  {                                                                                        \
    prefix##restart, prefix##evolve, #prefix, #restart, #evolve, family##_ONE_STEP,        \
        get_nonlinear_stats, prefix##GetReturnFlagName, prefix##Free, prefix##SetUserData, \
        prefix##WFtolerances, prefix##SetMaxNumSteps, prefix##SetMaxStep,                  \
        prefix##GetNumErrTestFails, family##_ROOT_RETURN, prefix##RootInit,                \
        prefix##SetRootDirection, prefix##SetNoInactiveRootWarn, prefix##GetRootInfo,      \
        prefix##GetCurrentTime, prefix##GetLastStep, prefix##GetCurrentStep,               \
        prefix##SetInitStep SUBIMPACT_MESSAGE_HANDLER(prefix)                              \
  }

/// The part that every SUNDIALS solver here shares: its memory and state, options, C callbacks,
/// steps, and root-finding on the library's dense output with what the library misses or fails at
/// by itself (docs/theory.md, "Events"). The user data of the library is this frame.
///
/// No exception crosses a C frame: an exception from a callback is stored, the library is stopped
/// by a return value, and the exception is rethrown unchanged after the call. The library's own
/// messages are kept for the failure that follows them.
class SolverFrame {
 public:
  SolverFrame(SecondOrderOde& ode, const IntegratorOptions& options, const LibraryCalls& calls,
              ContextPointer context);
  SolverFrame(const SolverFrame&) = delete;
  SolverFrame& operator=(const SolverFrame&) = delete;

  void reset(double t, const State& y);
  /// After a reset, which keeps the length of the next step.
  void limit_first_step(double longest);
  /// One step, to its end or to the first event in it; returns the time reached.
  double step();
  /// The state reached.
  void read(State& y);
  const std::optional<Integrator::Root>& root() const { return root_; }
  /// After a step that a root ended: clears the flag that ARKODE keeps of the root, which costs
  /// every later step evaluations for dense output. No step is taken.
  void drain_root();
  /// Evaluations of the right-hand side and, as the library counts them, rejected steps, iterations
  /// and their failures.
  void add_counts(WorkCounts& counts) const;

 protected:
  ~SolverFrame() = default;

  // Takes the solver that the library has made, null if it could not.
  void own(void* memory);
  void release() { memory_.reset(); }
  // Weights and limits of the steps, after the library's initialisation.
  void set_step_control(const IntegratorOptions& options);
  void* memory() const { return memory_.get(); }
  SUNContext context() const { return context_.get(); }
  N_Vector vector() const { return y_.get(); }

  static SolverFrame& of(void* user_data) { return *static_cast<SolverFrame*>(user_data); }
  // y' = [v, a(q, v)] of y = [q, v].
  static int rate(sunrealtype t, N_Vector y, N_Vector rate, void* frame);
  // y' = [v, ..] at the time t, the second half written by `write_second(y, half)`.
  template <class Second>
  int write_rate(sunrealtype t, N_Vector y, N_Vector rate, Second write_second) {
    ++right_hand_sides_;
    return guarded([&] {
      const auto in = entries(y), out = entries(rate);
      std::ranges::copy(in.last(n_positions_), out.begin());
      ode_.set_time(t);
      write_second(in, out.last(n_positions_));
    });
  }
  // Runs a callback's body: 0, or -1 if it threw.
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
  // Throws what a callback threw; otherwise IntegrationFailure if `flag` reports one. `function`:
  // the library's, without its prefix.
  void check(int flag, const char* function);
  bool finds_roots() const { return functions_ != nullptr; }

  SecondOrderOde& ode_;
  std::size_t n_positions_;
  double time_ = 0.0;  // s, up to which the solution is good
  long right_hand_sides_ = 0;

 private:
  struct FreeMemory {
    void (*free)(void**);
    void operator()(void* memory) const { free(&memory); }
  };
  // Calls the library once in its one-step mode.
  int evolve(double& reached);
  // Declares the event functions, before the first step from y. Returns the library's flag.
  int restart_roots(std::span<const double> y);
  // The first function that is positive and does not fall.
  std::optional<Integrator::Root> risen_function(std::span<const double> y);
  // Whether the root that the library reports is an event, and no maximum.
  bool find_event();
  // The library's own tolerance on the times of roots, s.
  double root_tolerance() const;
  // Whether the library has no rest of the step to search: called again, it would take a step.
  bool is_at_end(double reached) const;
  static int error_weights(N_Vector y, N_Vector weights, void* frame);
  // g of every function, then -g' of every function.
  static int event_values(sunrealtype t, N_Vector y, sunrealtype* result, void* frame);
#if SUNDIALS_VERSION_MAJOR < 7
  static void keep_message(int code, const char* module, const char* function, char* message,
                           void* frame);
#endif

  const LibraryCalls& calls_;
  std::shared_ptr<const EventFunctions> functions_;  // null: no root-finding
  std::vector<EventValue> values_;
  std::vector<int> root_flags_;
  bool is_silent_ = false;
  std::optional<Integrator::Root> root_, root_at_restart_;
  ContextPointer context_;
  VectorPointer y_;
  std::unique_ptr<void, FreeMemory> memory_;
  double position_weight_, velocity_weight_;
  std::exception_ptr thrown_;
  std::string message_;
};

}  // namespace subimpact
