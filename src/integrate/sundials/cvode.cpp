#include "integrate/sundials.h"

#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <utility>

#include "integrate/sundials/newton_matrices.h"
#include "integrate/sundials/solver_frame.h"

namespace subimpact {
namespace {

const LibraryCalls cvode_calls =
    SUBIMPACT_LIBRARY_CALLS(CVode, CV, ReInit, , CVodeGetNonlinSolvStats);

// What CVODE's two families share; each attaches its own nonlinear solver after construction.
class CvodeIntegrator : public Integrator, protected SolverFrame {
 public:
  // `family` is CV_ADAMS or CV_BDF.
  CvodeIntegrator(SecondOrderOde& ode, int family, const IntegratorOptions& options)
      : SolverFrame(ode, options, cvode_calls, make_context()) {
    own(CVodeCreate(family, context()));
    check(CVodeInit(memory(), rate, 0.0, vector()), "Init");
    set_step_control(options);
    check(CVodeSetMaxOrd(memory(), options.max_order), "SetMaxOrd");
  }

  void restart(double t, const State& y) override {
    work_ = CvodeIntegrator::work();
    reset(t, y);
    stand_at(t, y);
  }

  void step() override {
    const double reached = SolverFrame::step();
    std::swap(y0_, y1_);
    read(y1_);
    t0_ = t1_;
    t1_ = reached;
    ++work_.steps;
  }

  std::optional<Root> root() const override { return SolverFrame::root(); }

  void state_at(double t, State& y) override {
    check(CVodeGetDky(memory(), t, 0, vector()), "GetDky");
    read(y);
    ++work_.partial_steps;
  }

  // What the library counts are the numbers since the last restart.
  WorkCounts work() const override {
    WorkCounts counts = work_;
    add_counts(counts);
    counts.right_hand_sides = right_hand_sides_;
    return counts;
  }
};

class Adams final : public CvodeIntegrator {
 public:
  Adams(SecondOrderOde& ode, const IntegratorOptions& options)
      : CvodeIntegrator(ode, CV_ADAMS, options),
        iteration_(SUNNonlinSol_FixedPoint(vector(), 0, context())) {
    if (!iteration_) throw IntegrationFailure(0.0, "SUNNonlinSol_FixedPoint", "no memory", "");
    check(CVodeSetNonlinearSolver(memory(), iteration_.get()), "SetNonlinearSolver");
  }

 private:
  Owned<SUNNonlinearSolver, SUNNonlinSolFree> iteration_;
};

class Bdf final : public CvodeIntegrator {
 public:
  Bdf(MechanicalSystem& system, const IntegratorOptions& options)
      : CvodeIntegrator(system, CV_BDF, options), newton_(system, context()) {
    check(CVodeSetLinearSolver(memory(), newton_.solver(), newton_.matrix()), "SetLinearSolver");
    check(CVodeSetLinSysFn(memory(), newton_matrix), "SetLinSysFn");
  }

  WorkCounts work() const override {
    WorkCounts counts = CvodeIntegrator::work();
    newton_.add_counts(counts);
    return counts;
  }

 private:
  static int newton_matrix(sunrealtype, N_Vector y, N_Vector, SUNMatrix,
                           sunbooleantype keep_tangents, sunbooleantype* updated, sunrealtype gamma,
                           void* frame, N_Vector, N_Vector, N_Vector) {
    auto& self = static_cast<Bdf&>(static_cast<CvodeIntegrator&>(of(frame)));
    *updated = keep_tangents ? SUNFALSE : SUNTRUE;
    return self.guarded([&] { self.newton_.update(entries(y), keep_tangents, gamma); });
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
