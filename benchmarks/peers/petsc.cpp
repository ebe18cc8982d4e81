#include <petscts.h>

#include "peer.h"

namespace subimpact::peers {
namespace {

void initialise() {
  static const bool done = [] {
    PetscInitializeNoArguments();
    PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
    return true;
  }();
  (void)done;
}

// The array that a vector wraps has been written to.
void note_change(Vec vector) {
  PetscScalar* array = nullptr;
  VecGetArray(vector, &array);
  VecRestoreArray(vector, &array);
}

class Petsc final : public PeerIntegrator {
 public:
  Petsc(SecondOrderOde& ode, const StepControl& control, const char* table)
      : PeerIntegrator(ode, control) {
    initialise();
    const auto n = static_cast<PetscInt>(equations_.size());
    VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, present_.data(), &y_);
    VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, trial_.data(), &exact_y_);
    stepper_ = make(table, y_);
    exact_ = make(table, exact_y_);
    TSSetTolerances(stepper_, absolute_, nullptr, 0.0, nullptr);
    TSAdapt adapt = nullptr;
    TSGetAdapt(stepper_, &adapt);
    TSAdaptSetType(adapt, TSADAPTBASIC);
    if (control.max_step) TSAdaptSetStepLimits(adapt, 0.0, longest_);
    TSSetTimeStep(stepper_, 1e-3);
    TSGetAdapt(exact_, &adapt);
    TSAdaptSetType(adapt, TSADAPTNONE);
  }
  ~Petsc() override {
    TSDestroy(&stepper_);
    TSDestroy(&exact_);
    VecDestroy(&y_);
    VecDestroy(&exact_y_);
  }
  Petsc(const Petsc&) = delete;
  Petsc& operator=(const Petsc&) = delete;

 protected:
  void reset() override {
    note_change(y_);
    TSSetTime(stepper_, 0.0);
    TSRestartStep(stepper_);
  }
  double take_step() override {
    PetscReal before = 0.0;
    PetscReal after = 0.0;
    TSGetTime(stepper_, &before);
    TSSetReason(stepper_);
    if (TSStep(stepper_) != 0) fail("TSStep", "error");
    TSConvergedReason reason = TS_CONVERGED_ITERATING;
    TSGetConvergedReason(stepper_, &reason);
    if (reason < 0) fail("TSStep", TSConvergedReasons[reason]);
    TSGetTime(stepper_, &after);
    return after - before;
  }
  void take_exactly(double length, std::vector<double>& y) override {
    // y is trial_, which the vector wraps.
    if (&y != &trial_) fail("take_exactly", "another vector");
    note_change(exact_y_);
    TSSetTime(exact_, 0.0);
    TSSetTimeStep(exact_, length);
    TSRestartStep(exact_);
    TSSetReason(exact_);
    if (TSStep(exact_) != 0) fail("TSStep", "error");
  }

 private:
  static void TSSetReason(TS ts) { TSSetConvergedReason(ts, TS_CONVERGED_ITERATING); }

  TS make(const char* table, Vec y) {
    TS ts = nullptr;
    TSCreate(PETSC_COMM_SELF, &ts);
    TSSetProblemType(ts, TS_NONLINEAR);
    TSSetType(ts, TSRK);
    TSRKSetType(ts, table);
    TSSetRHSFunction(ts, nullptr, rate, this);
    TSSetMaxTime(ts, 1e300);
    TSSetMaxSteps(ts, PETSC_MAX_INT);
    TSSetExactFinalTime(ts, TS_EXACTFINALTIME_STEPOVER);
    TSSetSolution(ts, y);
    TSSetUp(ts);
    return ts;
  }
  static PetscErrorCode rate(TS, PetscReal, Vec y, Vec result, void* self) {
    const PetscScalar* from = nullptr;
    PetscScalar* to = nullptr;
    VecGetArrayRead(y, &from);
    VecGetArrayWrite(result, &to);
    static_cast<Petsc*>(self)->equations_(from, to);
    VecRestoreArrayWrite(result, &to);
    VecRestoreArrayRead(y, &from);
    return 0;
  }

  Vec y_ = nullptr, exact_y_ = nullptr;
  TS stepper_ = nullptr, exact_ = nullptr;
};

Peer peer(const char* name, const char* table) {
  return {name,
          [table](SecondOrderOde& ode, const StepControl& control) -> std::unique_ptr<Integrator> {
            return std::make_unique<Petsc>(ode, control, table);
          }};
}

}  // namespace

std::vector<Peer> petsc_peers() {
  return {peer("PETSc TS 5dp", TSRK5DP), peer("PETSc TS 8vr", TSRK8VR)};
}

}  // namespace subimpact::peers
