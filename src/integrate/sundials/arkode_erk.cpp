#include "integrate/arkode_erk.h"

#include <arkode/arkode_erkstep.h>

#include <algorithm>

#include "integrate/sundials/butcher_tables.h"
#include "integrate/sundials/one_step_integrator.h"
#include "integrate/sundials/solver_frame.h"
#include "integrate/sundials/vector.h"

namespace subimpact {
namespace {

// Degree 5 takes four evaluations per time instead of one and is not more accurate.
constexpr int dense_output_degree = 4;

constexpr RootCalls root_calls = {ARK_ROOT_RETURN,         ERKStepRootInit,
                                  ERKStepSetRootDirection, ERKStepSetNoInactiveRootWarn,
                                  ERKStepGetRootInfo,      ERKStepGetCurrentTime,
                                  ERKStepGetLastStep};

class ErkSolver : private SolverFrame {
 public:
  ErkSolver(SecondOrderOde& ode, const IntegratorOptions& options, SUNContext context)
      : SolverFrame(ode, options, root_calls, context) {
    y_ = make_vector(2 * n_positions_, context, options.vector_operations);
    N_VConst(0.0, y_.get());
    memory_.reset(ERKStepCreate(rate, 0.0, y_.get(), context));
    if (!memory_) throw IntegrationFailure(0.0, "ERKStepCreate", "no memory", "");
    check(ERKStepSetUserData(memory_.get(), user_data()), "ERKStepSetUserData");
#if SUNDIALS_VERSION_MAJOR < 7
    check(ERKStepSetErrHandlerFn(memory_.get(), keep_message, user_data()),
          "ERKStepSetErrHandlerFn");
#endif
    check(ERKStepWFtolerances(memory_.get(), error_weights), "ERKStepWFtolerances");
    const ButcherTablePointer table = load_explicit_table(options.table);
    check(ERKStepSetTable(memory_.get(), table.get()), "ERKStepSetTable");
    check(ERKStepSetMaxNumSteps(memory_.get(), -1), "ERKStepSetMaxNumSteps");
    if (options.max_step) {
      check(ERKStepSetMaxStep(memory_.get(), *options.max_step), "ERKStepSetMaxStep");
    }
    if (roots_.is_on()) {
      check(ERKStepSetInterpolantDegree(memory_.get(), dense_output_degree),
            "ERKStepSetInterpolantDegree");
    }
    if (options.fixed_step) set_fixed_step(*options.fixed_step);
  }

  void set_fixed_step(double step) {
    check(ERKStepSetFixedStep(memory_.get(), step), "ERKStepSetFixedStep");
  }

  void reset(double t, const State& y) {
    std::copy(y.begin(), y.end(), entries(y_.get()).begin());
    check(ERKStepReset(memory_.get(), t, y_.get()), "ERKStepReset");
    check(roots_.restart(memory_.get(), event_values, y), "ERKStepRootInit");
    time_ = t;
  }

  /// One step; returns the time reached.
  double step(State& y) {
    double reached = time_;
    const auto evolve = [&] {
      return ERKStepEvolve(memory_.get(), time_ahead(time_), y_.get(), &reached, ARK_ONE_STEP);
    };
    check(roots_.step(memory_.get(), reached, entries(y_.get()), evolve), "ERKStepEvolve");
    const auto values = entries(y_.get());
    std::copy(values.begin(), values.end(), y.begin());
    time_ = reached;
    roots_.drain(memory_.get(), reached, evolve);
    return time_;
  }
  const std::optional<Integrator::Root>& root() const { return roots_.root(); }

  void add_counts(WorkCounts& counts) const {
    long rejected = 0;
    ERKStepGetNumErrTestFails(memory_.get(), &rejected);
    counts.rejected_steps += rejected;
    counts.right_hand_sides += right_hand_sides_;
  }

 private:
  struct FreeMemory {
    void operator()(void* memory) const { ERKStepFree(&memory); }
  };

  void check(int flag, const char* function) {
    SolverFrame::check(flag, function, ERKStepGetReturnFlagName);
  }

  VectorPointer y_;
  std::unique_ptr<void, FreeMemory> memory_;
};

}  // namespace

std::unique_ptr<Integrator> make_arkode_erk(SecondOrderOde& ode, const IntegratorOptions& options) {
  return std::make_unique<OneStepIntegrator<ErkSolver>>(ode, options);
}

}  // namespace subimpact
