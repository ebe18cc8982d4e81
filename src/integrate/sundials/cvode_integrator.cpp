#include "integrate/sundials/cvode_integrator.h"

#include <cvode/cvode.h>

#include <algorithm>
#include <utility>

namespace subimpact {

void CvodeIntegrator::FreeMemory::operator()(void* memory) const { CVodeFree(&memory); }

CvodeIntegrator::CvodeIntegrator(SecondOrderOde& ode, int family, const CvodeOptions& options)
    : CvodeIntegrator(ode, family, options, make_context()) {}

CvodeIntegrator::CvodeIntegrator(SecondOrderOde& ode, int family, const CvodeOptions& options,
                                 ContextPointer context)
    : SolverFrame(ode, options.relative_tolerance, context.get()),
      ode_(ode),
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

void CvodeIntegrator::restart(double t, const State& y) {
  const WorkCounts so_far = counts_since_restart();
  before_restart_.rejected_steps += so_far.rejected_steps;
  before_restart_.nonlinear_iterations += so_far.nonlinear_iterations;
  before_restart_.nonlinear_failures += so_far.nonlinear_failures;
  std::copy(y.begin(), y.end(), entries(y_.get()).begin());
  check(CVodeReInit(memory(), t, y_.get()), "CVodeReInit");
  time_ = t0_ = t1_ = t;
  y0_ = y;
  y1_ = y;
}

void CvodeIntegrator::step() {
  double reached = t1_;
  check(CVode(memory(), time_ahead(t1_), y_.get(), &reached, CV_ONE_STEP), "CVode");
  std::swap(y0_, y1_);
  t0_ = t1_;
  time_ = t1_ = reached;
  const auto values = entries(y_.get());
  std::copy(values.begin(), values.end(), y1_.begin());
  ++steps_;
}

void CvodeIntegrator::state_at(double t, State& y) {
  check(CVodeGetDky(memory(), t, 0, y_.get()), "CVodeGetDky");
  const auto values = entries(y_.get());
  y.assign(values.begin(), values.end());
  ++partial_steps_;
}

WorkCounts CvodeIntegrator::counts_since_restart() const {
  WorkCounts counts;
  CVodeGetNumErrTestFails(memory(), &counts.rejected_steps);
  CVodeGetNonlinSolvStats(memory(), &counts.nonlinear_iterations, &counts.nonlinear_failures);
  return counts;
}

WorkCounts CvodeIntegrator::work() const {
  WorkCounts counts = counts_since_restart();
  counts.rejected_steps += before_restart_.rejected_steps;
  counts.nonlinear_iterations += before_restart_.nonlinear_iterations;
  counts.nonlinear_failures += before_restart_.nonlinear_failures;
  counts.steps = steps_;
  counts.partial_steps = partial_steps_;
  counts.right_hand_sides = right_hand_sides_;
  return counts;
}

int CvodeIntegrator::rate(sunrealtype, N_Vector y, N_Vector rate, void* frame) {
  auto& self = static_cast<CvodeIntegrator&>(of(frame));
  const std::size_t n = self.n_positions_;
  const auto in = entries(y);
  const auto out = entries(rate);
  ++self.right_hand_sides_;
  return self.guarded([&] {
    std::copy_n(in.begin() + static_cast<std::ptrdiff_t>(n), n, out.begin());
    self.ode_.acceleration(in.first(n), out.subspan(n));
  });
}

void CvodeIntegrator::check(int flag, const char* function) {
  SolverFrame::check(flag, function, CVodeGetReturnFlagName);
}

}  // namespace subimpact
