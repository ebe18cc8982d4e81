#include "integrate/arkode_erk.h"

#include <arkode/arkode_erkstep.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <utility>

#include "integrate/sundials/butcher_tables.h"
#include "integrate/sundials/vector.h"

namespace subimpact {
namespace {

/// One ERKStep solver and what its C callbacks need. No exception crosses a C frame: the right-hand
/// side's is kept, the library told to stop, and it is thrown again after the call.
class ErkSolver {
 public:
  ErkSolver(SecondOrderOde& ode, const ErkOptions& options, SUNContext context)
      : ode_(ode), n_(ode.n_positions()) {
    y_ = make_vector(2 * n_, context, options.vector_operations);
    N_VConst(0.0, y_.get());
    memory_.reset(ERKStepCreate(right_hand_side, 0.0, y_.get(), context));
    if (!memory_) throw IntegrationFailure(0.0, "ERKStepCreate", "no memory", "");
    const SecondOrderOde::Scales scales = ode.scales();
    position_weight_ = 1.0 / (options.relative_tolerance * scales.position);
    velocity_weight_ = 1.0 / (options.relative_tolerance * scales.velocity);
    check(ERKStepSetUserData(memory_.get(), this), "ERKStepSetUserData");
    check(ERKStepSetErrHandlerFn(memory_.get(), keep_message, this), "ERKStepSetErrHandlerFn");
    check(ERKStepWFtolerances(memory_.get(), error_weights), "ERKStepWFtolerances");
    const ButcherTablePointer table = load_explicit_table(options.table);
    check(ERKStepSetTable(memory_.get(), table.get()), "ERKStepSetTable");
    check(ERKStepSetMaxNumSteps(memory_.get(), -1), "ERKStepSetMaxNumSteps");
    if (options.max_step) {
      check(ERKStepSetMaxStep(memory_.get(), *options.max_step), "ERKStepSetMaxStep");
    }
    if (options.fixed_step) set_fixed_step(*options.fixed_step);
  }

  void set_fixed_step(double step) {
    check(ERKStepSetFixedStep(memory_.get(), step), "ERKStepSetFixedStep");
  }

  void reset(double t, const State& y) {
    std::copy(y.begin(), y.end(), entries(y_.get()).begin());
    check(ERKStepReset(memory_.get(), t, y_.get()), "ERKStepReset");
    t_ = t;
  }

  /// One step; returns the time reached.
  double step(State& y) {
    double reached = t_;
    // In one-step mode the output time only says which way time runs.
    const double ahead = t_ + std::max(1.0, 2.0 * t_);
    const int flag = ERKStepEvolve(memory_.get(), ahead, y_.get(), &reached, ARK_ONE_STEP);
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
    check(flag, "ERKStepEvolve");
    const auto values = entries(y_.get());
    std::copy(values.begin(), values.end(), y.begin());
    t_ = reached;
    return reached;
  }

  long right_hand_sides() const { return right_hand_sides_; }
  long rejected_steps() const {
    long count = 0;
    ERKStepGetNumErrTestFails(memory_.get(), &count);
    return count;
  }

 private:
  struct FreeMemory {
    void operator()(void* memory) const { ERKStepFree(&memory); }
  };

  static int right_hand_side(realtype, N_Vector y, N_Vector rate, void* self_pointer) {
    auto& self = *static_cast<ErkSolver*>(self_pointer);
    const std::size_t n = self.n_;
    const auto in = entries(y);
    const auto out = entries(rate);
    ++self.right_hand_sides_;
    try {
      std::copy_n(in.begin() + static_cast<std::ptrdiff_t>(n), n, out.begin());
      self.ode_.acceleration(in.first(n), out.subspan(n));
    } catch (...) {
      self.thrown_ = std::current_exception();
      return -1;
    }
    return 0;
  }

  // Asked for at every step, but constant.
  static int error_weights(N_Vector, N_Vector weights, void* self_pointer) {
    const auto& self = *static_cast<const ErkSolver*>(self_pointer);
    const auto out = entries(weights);
    if (out.front() == self.position_weight_ && out.back() == self.velocity_weight_) return 0;
    const auto middle = out.begin() + static_cast<std::ptrdiff_t>(self.n_);
    std::fill(out.begin(), middle, self.position_weight_);
    std::fill(middle, out.end(), self.velocity_weight_);
    return 0;
  }

  static void keep_message(int code, const char*, const char*, char* message, void* self_pointer) {
    if (code < 0) static_cast<ErkSolver*>(self_pointer)->message_ = message;
  }

  void check(int flag, const char* function) {
    if (flag >= 0) return;
    char* name = ERKStepGetReturnFlagName(flag);
    const std::string flag_name = name ? name : std::to_string(flag);
    std::free(name);
    throw IntegrationFailure(t_, function, flag_name, message_);
  }

  SecondOrderOde& ode_;
  std::size_t n_;
  double t_ = 0.0;
  double position_weight_ = 0.0, velocity_weight_ = 0.0;
  VectorPointer y_;
  std::unique_ptr<void, FreeMemory> memory_;
  std::exception_ptr thrown_;
  std::string message_;
  long right_hand_sides_ = 0;
};

class ArkodeErk final : public Integrator {
 public:
  ArkodeErk(SecondOrderOde& ode, const ErkOptions& options)
      : context_(make_context()),
        main_(ode, options, context_.get()),
        partial_(ode, as_fixed(options), context_.get()) {}

  void restart(double t, const State& y) override {
    main_.reset(t, y);
    t0_ = t1_ = t;
    y0_ = y;
    y1_ = y;
  }

  void step() override {
    std::swap(y0_, y1_);
    t0_ = t1_;
    t1_ = main_.step(y1_);
    ++steps_;
  }

  void state_at(double t, State& y) override {
    y.resize(y0_.size());
    partial_.set_fixed_step(t - t0_);
    partial_.reset(t0_, y0_);
    partial_.step(y);
    ++partial_steps_;
  }

  WorkCounts work() const override {
    WorkCounts counts;
    counts.steps = steps_;
    counts.rejected_steps = main_.rejected_steps();
    counts.partial_steps = partial_steps_;
    counts.right_hand_sides = main_.right_hand_sides() + partial_.right_hand_sides();
    return counts;
  }

 private:
  static ErkOptions as_fixed(ErkOptions options) {
    options.fixed_step = options.fixed_step.value_or(1.0);  // set anew before every use
    options.max_step.reset();
    return options;
  }

  ContextPointer context_;
  ErkSolver main_;
  ErkSolver partial_;
  long steps_ = 0;
  long partial_steps_ = 0;
};

}  // namespace

std::unique_ptr<Integrator> make_arkode_erk(SecondOrderOde& ode, const ErkOptions& options) {
  return std::make_unique<ArkodeErk>(ode, options);
}

}  // namespace subimpact
