#pragma once

#include <sundials/sundials_version.h>

#include <cstddef>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
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
#if SUNDIALS_VERSION_MAJOR < 7
  int (*set_message_handler)(void*, void (*)(int, const char*, const char*, char*, void*), void*);
#endif
};

#if SUNDIALS_VERSION_MAJOR < 7
#define SUBIMPACT_MESSAGE_HANDLER(prefix) , prefix##SetErrHandlerFn
#else
#define SUBIMPACT_MESSAGE_HANDLER(prefix)
#endif
/// Those of one prefix; `family`: that of the library's constants.
#define SUBIMPACT_LIBRARY_CALLS(prefix, family, restart, evolve, get_nonlinear_stats)      \
  {                                                                                        \
    prefix##restart, prefix##evolve, #prefix, #restart, #evolve, family##_ONE_STEP,        \
        get_nonlinear_stats, prefix##GetReturnFlagName, prefix##Free, prefix##SetUserData, \
        prefix##WFtolerances, prefix##SetMaxNumSteps, prefix##SetMaxStep,                  \
        prefix##GetNumErrTestFails, family##_ROOT_RETURN, prefix##RootInit,                \
        prefix##SetRootDirection, prefix##SetNoInactiveRootWarn, prefix##GetRootInfo,      \
        prefix##GetCurrentTime, prefix##GetLastStep SUBIMPACT_MESSAGE_HANDLER(prefix)      \
  }

/// The root-finding of one SUNDIALS solver, on the library's dense output, and what it misses or
/// fails at by itself (docs/theory.md, "Events").
class RootFinder {
 public:
  /// `functions` may be null: no root-finding.
  RootFinder(std::shared_ptr<const EventFunctions> functions, const LibraryCalls& calls)
      : functions_(std::move(functions)), calls_(calls) {}

  bool is_on() const { return functions_ != nullptr; }

  /// Declares the functions, before the first step from y. Returns the library's flag.
  int restart(void* memory, int (*callback)(sunrealtype, N_Vector, sunrealtype*, void*),
              std::span<const double> y);

  /// One step, to its end or to the first event in it, and its flag. `evolve()` calls the library
  /// in its one-step mode, writes time and state to `reached` and `y`, and returns its flag.
  template <class Evolve>
  int step(void* memory, const double& reached, std::span<const double> y, Evolve evolve) {
    if (!is_on()) return evolve();
    root_ = std::exchange(root_at_restart_, std::nullopt);
    if (root_) return 0;
    int flag = evolve();
    while (flag == calls_.root_return && !find_event(memory) && !is_at_end(memory, reached)) {
      flag = evolve();  // a maximum: the rest of the step
    }
    if (flag >= 0 && !root_) root_ = risen_function(y);
    return flag;
  }
  const std::optional<Integrator::Root>& root() const { return root_; }

  /// After a step that a root ended: clears the flag that ARKODE keeps of the root, which costs
  /// every later step evaluations for dense output. `evolve` as in step(); no step is taken.
  template <class Evolve>
  void drain(void* memory, const double& reached, Evolve evolve) {
    if (!root_ || is_at_end(memory, reached)) return;
    is_silent_ = true;
    evolve();
    is_silent_ = false;
  }

  /// For the library's callback: g of every function, then -g' of every function.
  void evaluate(std::span<const double> y, sunrealtype* result);

 private:
  // The first function that is positive and does not fall.
  std::optional<Integrator::Root> risen_function(std::span<const double> y);
  bool find_event(void* memory);
  // The library's own tolerance on the times of roots, s.
  double tolerance(void* memory) const;
  // Whether the library has no rest of the step to search: called again, it would take a step.
  bool is_at_end(void* memory, double reached) const;

  std::shared_ptr<const EventFunctions> functions_;
  const LibraryCalls& calls_;
  std::vector<EventValue> values_;
  std::vector<int> flags_;
  bool is_silent_ = false;
  std::optional<Integrator::Root> root_, root_at_restart_;
};

/// The part that every SUNDIALS solver here shares: its memory and state, options, steps with
/// root-finding, C callbacks. The user data of the library is this frame.
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
  /// One step, to its end or to the first event in it; returns the time reached.
  double step();
  void read(State& y) const;
  const std::optional<Integrator::Root>& root() const { return roots_.root(); }
  void drain_root() {
    double reached = time_;
    roots_.drain(memory(), reached, [&] { return evolve(reached); });
  }
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
  void* user_data() { return this; }
  // y' = [v, a(q, v)] of y = [q, v].
  static int rate(sunrealtype t, N_Vector y, N_Vector rate, void* frame);
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
  // Calls the library once in its one-step mode.
  int evolve(double& reached);

  SecondOrderOde& ode_;
  std::size_t n_positions_;
  double time_ = 0.0;  // s, up to which the solution is good
  long right_hand_sides_ = 0;
  RootFinder roots_;

 private:
  struct FreeMemory {
    void (*free)(void**);
    void operator()(void* memory) const { free(&memory); }
  };
  static int error_weights(N_Vector y, N_Vector weights, void* frame);
  static int event_values(sunrealtype t, N_Vector y, sunrealtype* values, void* frame);
#if SUNDIALS_VERSION_MAJOR < 7
  static void keep_message(int code, const char* module, const char* function, char* message,
                           void* frame);
#endif

  const LibraryCalls& calls_;
  ContextPointer context_;
  VectorPointer y_;
  std::unique_ptr<void, FreeMemory> memory_;
  double position_weight_, velocity_weight_;
  std::exception_ptr thrown_;
  std::string message_;
};

}  // namespace subimpact
