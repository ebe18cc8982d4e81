#pragma once

#include <memory>

#include "integrate/cvode.h"
#include "integrate/sundials/solver_frame.h"
#include "integrate/sundials/vector.h"

namespace subimpact {

/// What CVODE's two families share; each attaches its own nonlinear solver after construction.
class CvodeIntegrator : public Integrator, protected SolverFrame {
 public:
  void restart(double t, const State& y) override;
  void step() override;
  void state_at(double t, State& y) override;
  WorkCounts work() const override;

 protected:
  /// `family` is CV_ADAMS or CV_BDF.
  CvodeIntegrator(SecondOrderOde& ode, int family, const CvodeOptions& options);

  SUNContext context() const { return context_.get(); }
  void* memory() const { return memory_.get(); }
  N_Vector vector() const { return y_.get(); }
  void check(int flag, const char* function);

 private:
  struct FreeMemory {
    void operator()(void* memory) const;
  };
  CvodeIntegrator(SecondOrderOde& ode, int family, const CvodeOptions& options,
                  ContextPointer context);
  static int rate(sunrealtype, N_Vector y, N_Vector rate, void* frame);
  /// The counts since the last restart, which the library's reset.
  WorkCounts counts_since_restart() const;

  SecondOrderOde& ode_;
  ContextPointer context_;
  VectorPointer y_;
  std::unique_ptr<void, FreeMemory> memory_;
  long steps_ = 0;
  long partial_steps_ = 0;
  WorkCounts before_restart_;
};

}  // namespace subimpact
