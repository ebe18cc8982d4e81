#include "integrate/cvode.h"

#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <utility>

#include "integrate/sundials/reduced_newton.h"
#include "integrate/sundials/solver_frame.h"
#include "integrate/sundials/vector.h"

namespace subimpact {
namespace {

constexpr RootCalls root_calls = {
    CV_ROOT_RETURN,   CVodeRootInit,       CVodeSetRootDirection, CVodeSetNoInactiveRootWarn,
    CVodeGetRootInfo, CVodeGetCurrentTime, CVodeGetLastStep};

// What CVODE's two families share; each attaches its own nonlinear solver after construction.
class CvodeIntegrator : public Integrator, protected SolverFrame {
 public:
  void restart(double t, const State& y) override {
    const WorkCounts so_far = counts_since_restart();
    before_restart_.rejected_steps += so_far.rejected_steps;
    before_restart_.nonlinear_iterations += so_far.nonlinear_iterations;
    before_restart_.nonlinear_failures += so_far.nonlinear_failures;
    std::copy(y.begin(), y.end(), entries(y_.get()).begin());
    check(CVodeReInit(memory(), t, y_.get()), "CVodeReInit");
    check(roots_.restart(memory(), event_values, y), "CVodeRootInit");
    stand_at(t, y);
    time_ = t;
  }

  void step() override {
    double reached = t1_;
    const auto evolve = [&] {
      return CVode(memory(), time_ahead(t1_), y_.get(), &reached, CV_ONE_STEP);
    };
    check(roots_.step(memory(), reached, entries(y_.get()), evolve), "CVode");
    std::swap(y0_, y1_);
    t0_ = t1_;
    time_ = t1_ = reached;
    const auto values = entries(y_.get());
    std::copy(values.begin(), values.end(), y1_.begin());
    ++steps_;
  }

  std::optional<Root> root() const override { return roots_.root(); }

  void state_at(double t, State& y) override {
    check(CVodeGetDky(memory(), t, 0, y_.get()), "CVodeGetDky");
    const auto values = entries(y_.get());
    y.assign(values.begin(), values.end());
    ++partial_steps_;
  }

  WorkCounts work() const override {
    WorkCounts counts = counts_since_restart();
    counts.rejected_steps += before_restart_.rejected_steps;
    counts.nonlinear_iterations += before_restart_.nonlinear_iterations;
    counts.nonlinear_failures += before_restart_.nonlinear_failures;
    counts.steps = steps_;
    counts.partial_steps = partial_steps_;
    counts.right_hand_sides = right_hand_sides_;
    return counts;
  }

 protected:
  // `family` is CV_ADAMS or CV_BDF.
  CvodeIntegrator(SecondOrderOde& ode, int family, const IntegratorOptions& options)
      : CvodeIntegrator(ode, family, options, make_context()) {}

  SUNContext context() const { return context_.get(); }
  void* memory() const { return memory_.get(); }
  N_Vector vector() const { return y_.get(); }
  void check(int flag, const char* function) {
    SolverFrame::check(flag, function, CVodeGetReturnFlagName);
  }

 private:
  struct FreeMemory {
    void operator()(void* memory) const { CVodeFree(&memory); }
  };

  CvodeIntegrator(SecondOrderOde& ode, int family, const IntegratorOptions& options,
                  ContextPointer context)
      : SolverFrame(ode, options, root_calls, context.get()),
        context_(std::move(context)),
        y_(make_vector(2 * n_positions_, context_.get(), options.vector_operations)),
        memory_(CVodeCreate(family, context_.get())) {
    void* memory = memory_.get();
    if (!memory) throw IntegrationFailure(0.0, "CVodeCreate", "no memory", "");
    N_VConst(0.0, y_.get());
#if SUNDIALS_VERSION_MAJOR < 7
    check(CVodeSetErrHandlerFn(memory, keep_message, user_data()), "CVodeSetErrHandlerFn");
#endif
    check(CVodeInit(memory, rate, 0.0, y_.get()), "CVodeInit");
    check(CVodeSetUserData(memory, user_data()), "CVodeSetUserData");
    check(CVodeWFtolerances(memory, error_weights), "CVodeWFtolerances");
    check(CVodeSetMaxOrd(memory, options.max_order), "CVodeSetMaxOrd");
    check(CVodeSetMaxNumSteps(memory, -1), "CVodeSetMaxNumSteps");
    if (options.max_step) check(CVodeSetMaxStep(memory, *options.max_step), "CVodeSetMaxStep");
  }

  // The counts since the last restart, which the library's reset.
  WorkCounts counts_since_restart() const {
    WorkCounts counts;
    CVodeGetNumErrTestFails(memory(), &counts.rejected_steps);
    CVodeGetNonlinSolvStats(memory(), &counts.nonlinear_iterations, &counts.nonlinear_failures);
    return counts;
  }

  ContextPointer context_;
  VectorPointer y_;
  std::unique_ptr<void, FreeMemory> memory_;
  long steps_ = 0;
  long partial_steps_ = 0;
  WorkCounts before_restart_;
};

struct FreeNonlinearSolver {
  void operator()(SUNNonlinearSolver solver) const { SUNNonlinSolFree(solver); }
};

class Adams final : public CvodeIntegrator {
 public:
  Adams(SecondOrderOde& ode, const IntegratorOptions& options)
      : CvodeIntegrator(ode, CV_ADAMS, options),
        iteration_(SUNNonlinSol_FixedPoint(vector(), 0, context())) {
    if (!iteration_) throw IntegrationFailure(0.0, "SUNNonlinSol_FixedPoint", "no memory", "");
    check(CVodeSetNonlinearSolver(memory(), iteration_.get()), "CVodeSetNonlinearSolver");
  }

 private:
  std::unique_ptr<std::remove_pointer_t<SUNNonlinearSolver>, FreeNonlinearSolver> iteration_;
};

class Bdf final : public CvodeIntegrator {
 public:
  Bdf(MechanicalSystem& system, const IntegratorOptions& options)
      : CvodeIntegrator(system, CV_BDF, options), newton_(system, context()) {
    check(CVodeSetLinearSolver(memory(), newton_.solver(), newton_.matrix()),
          "CVodeSetLinearSolver");
    check(CVodeSetLinSysFn(memory(), newton_matrix), "CVodeSetLinSysFn");
  }

  WorkCounts work() const override {
    WorkCounts counts = CvodeIntegrator::work();
    newton_.add_counts(counts);
    return counts;
  }

 private:
  static int newton_matrix(sunrealtype, N_Vector y, N_Vector, SUNMatrix,
                           sunbooleantype keep_stiffness, sunbooleantype* updated,
                           sunrealtype gamma, void* frame, N_Vector, N_Vector, N_Vector) {
    auto& self = static_cast<Bdf&>(static_cast<CvodeIntegrator&>(of(frame)));
    *updated = keep_stiffness ? SUNFALSE : SUNTRUE;
    return self.guarded([&] {
      if (!keep_stiffness) self.newton_.update_tangents(entries(y));
      self.newton_.assemble(gamma);
    });
  }

  ReducedNewton newton_;
};

}  // namespace

std::unique_ptr<Integrator> make_cvode_adams(SecondOrderOde& ode,
                                             const IntegratorOptions& options) {
  return std::make_unique<Adams>(ode, options);
}

std::unique_ptr<Integrator> make_cvode_bdf(MechanicalSystem& system,
                                           const IntegratorOptions& options) {
  return std::make_unique<Bdf>(system, options);
}

}  // namespace subimpact
