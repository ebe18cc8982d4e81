#pragma once

#include <sundials/sundials_nvector.h>
#include <sundials/sundials_types.h>

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ode/integrator.h"

namespace subimpact {

/// The root-finding calls of ERKStep, ARKStep or CVODE.
struct RootCalls {
  using Function = int (*)(sunrealtype, N_Vector, sunrealtype*, void*);
  int root_return;  ///< flag of a step that stopped at a root
  int (*init)(void*, int, Function);
  int (*set_directions)(void*, int*);
  int (*set_no_warning)(void*);
  int (*get_roots)(void*, int*);
  int (*get_current_time)(void*, sunrealtype*);
  int (*get_last_step)(void*, sunrealtype*);
};

/// The root-finding of one SUNDIALS solver, on the library's dense output. What this class adds:
///
/// - An event function g that rises through zero and falls back within one step has the same sign
///   at both ends. Where its rate is known, the library also searches for the roots of -g', the
///   maxima of g, and examines g there.
/// - The library takes an exact zero for a root, ignores a function that is zero at a restart until
///   the function has moved, and fails where one stays at zero ("Root found at and very near t").
///   It never receives an exact zero: zero counts as negative.
/// - All functions are searched for rising values only. The function of the event just passed,
///   which is near zero and falls, is not found again.
/// - A function that is positive at a restart and still rises has no sign change to come: its event
///   is at the restart itself. One that is positive and rises at the end of a step without a root
///   has its event there: late, for the caller to refuse.
/// - What the library keeps of the last root survives a restart. Functions are declared anew each
///   time, and drain() clears ARKODE's flag.
class RootFinder {
 public:
  /// `functions` may be null: no root-finding.
  RootFinder(std::shared_ptr<const EventFunctions> functions, const RootCalls& calls)
      : functions_(std::move(functions)), calls_(calls) {}

  bool is_on() const { return functions_ != nullptr; }

  /// Declares the functions, before the first step from y. Returns the library's flag.
  int restart(void* memory, RootCalls::Function callback, std::span<const double> y);

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
  /// The root that ended the last step.
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
  RootCalls calls_;
  std::vector<EventValue> values_;
  std::vector<int> flags_;
  bool is_silent_ = false;
  std::optional<Integrator::Root> root_, root_at_restart_;
};

}  // namespace subimpact
