#include "integrate/sundials.h"

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_erkstep.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "integrate/sundials/butcher_tables.h"
#include "integrate/sundials/newton_matrices.h"
#include "integrate/sundials/solver_frame.h"

namespace subimpact {
namespace {

// Degree 5 takes four evaluations per time instead of one and is not more accurate.
constexpr int dense_output_degree = 4;

// Newton's method. Sections that begin to flow or reverse change the stiffness from one stage to
// the next, and with a matrix kept over many steps the iteration then fails until the step is cut
// beyond recovery: the matrix is made anew each step (a twentieth of the step's cost), and ten
// iterations are allowed. The estimate of the rate of convergence starts from 1 then, and has to be
// allowed to fall as fast as it does, or linear stages are solved twice.
constexpr int steps_per_matrix = 1;
constexpr int max_iterations = 10;
constexpr double fastest_fall_of_rate = 1e-3;

// A step that failed is retaken with another gamma, and needs the matrix of that gamma. ARKStep
// means to make it, but before SUNDIALS 6.7 the mass solve of an explicit first stage wipes out the
// note of the failure, and the matrix is made only if gamma changed by more than a fifth. With the
// old matrix and the old, small estimate of the rate of convergence one iteration is taken for
// enough, and stages are wrong by far more than the tolerance. So any change requires a new matrix.
constexpr double largest_change_of_gamma = 1e-12;

const LibraryCalls erk_calls = SUBIMPACT_LIBRARY_CALLS(ERKStep, ARK, Reset, Evolve, nullptr);
const LibraryCalls ark_calls =
    SUBIMPACT_LIBRARY_CALLS(ARKStep, ARK, Reset, Evolve, ARKStepGetNonlinSolvStats);

class ErkSolver final : public SolverFrame {
 public:
  ErkSolver(SecondOrderOde& ode, const IntegratorOptions& options, ContextPointer shared)
      : SolverFrame(ode, options, erk_calls, std::move(shared)) {
    own(ERKStepCreate(rate, 0.0, vector(), context()));
    set_step_control(options);
    const ButcherTablePointer table = load_explicit_table(options.table);
    check(ERKStepSetTable(memory(), table.get()), "SetTable");
    if (finds_roots()) {
      check(ERKStepSetInterpolantDegree(memory(), dense_output_degree), "SetInterpolantDegree");
    }
    if (options.fixed_step) set_fixed_step(*options.fixed_step);
  }

  void set_fixed_step(double step) { check(ERKStepSetFixedStep(memory(), step), "SetFixedStep"); }
};

class ArkSolver final : public SolverFrame {
 public:
  ArkSolver(MechanicalSystem& system, const IntegratorOptions& options, ContextPointer shared)
      : SolverFrame(system, options, ark_calls, std::move(shared)),
        system_(system),
        matrices_(system, vector(), context()) {
    const ButcherTablePointer table = load_dirk_table(options.table);
    own(ARKStepCreate(nullptr, implicit_rate, 0.0, vector(), context()));
    set_step_control(options);
    void* const ark = memory();
    check(ARKStepSetTables(ark, table->q, table->p, table.get(), nullptr), "SetTables");
    check(
        ARKStepSetMassLinearSolver(ark, matrices_.mass_solver(), matrices_.mass_matrix(), SUNFALSE),
        "SetMassLinearSolver");
    check(ARKStepSetMassFn(ark, mass), "SetMassFn");
    check(ARKStepSetLinearSolver(ark, matrices_.newton_solver(), matrices_.newton_matrix()),
          "SetLinearSolver");
    check(ARKStepSetLinSysFn(ark, newton_matrix), "SetLinSysFn");
    // With roots, Lagrange interpolation would begin again at a low degree after every restart.
    // Without, dense output is not used, and Lagrange interpolation costs no evaluation.
    check(ARKStepSetInterpolantType(ark, finds_roots() ? ARK_INTERP_HERMITE : ARK_INTERP_LAGRANGE),
          "SetInterpolantType");
    if (finds_roots()) {
      check(ARKStepSetInterpolantDegree(ark, dense_output_degree), "SetInterpolantDegree");
    }
    check(ARKStepSetLSetupFrequency(ark, steps_per_matrix), "SetLSetupFrequency");
    check(ARKStepSetJacEvalFrequency(ark, steps_per_matrix), "SetJacEvalFrequency");
    check(ARKStepSetDeltaGammaMax(ark, largest_change_of_gamma), "SetDeltaGammaMax");
    check(ARKStepSetMaxNonlinIters(ark, max_iterations), "SetMaxNonlinIters");
    check(ARKStepSetNonlinCRDown(ark, fastest_fall_of_rate), "SetNonlinCRDown");
    if (options.fixed_step) set_fixed_step(*options.fixed_step);
  }

  ~ArkSolver() { release(); }  // which takes the matrices

  void set_fixed_step(double step) { check(ARKStepSetFixedStep(memory(), step), "SetFixedStep"); }

  void add_counts(WorkCounts& counts) const {
    long mass_solves = 0;
    ARKStepGetNumMassSolves(memory(), &mass_solves);
    counts.mass_solves += mass_solves;
    matrices_.add_counts(counts);
    SolverFrame::add_counts(counts);
  }

 private:
  static int implicit_rate(sunrealtype t, N_Vector y, N_Vector rate, void* frame) {
    auto& self = static_cast<ArkSolver&>(of(frame));
    return self.write_rate(t, y, rate, [&](auto in, auto out) { self.system_.force(in, out); });
  }

  static int mass(sunrealtype, SUNMatrix matrix, void* frame, N_Vector, N_Vector, N_Vector) {
    auto& self = static_cast<ArkSolver&>(of(frame));
    return self.guarded([&] { self.matrices_.fill_mass(matrix); });
  }

  static int newton_matrix(sunrealtype, N_Vector y, N_Vector, SUNMatrix, SUNMatrix,
                           sunbooleantype keep_tangents, sunbooleantype* updated, sunrealtype gamma,
                           void* frame, N_Vector, N_Vector, N_Vector) {
    auto& self = static_cast<ArkSolver&>(of(frame));
    *updated = keep_tangents ? SUNFALSE : SUNTRUE;
    return self.guarded([&] { self.matrices_.update(entries(y), keep_tangents, gamma); });
  }

  MechanicalSystem& system_;
  BlockSystem matrices_;
};

/// An integrator out of two solvers of one one-step method: one goes forward, the other retakes
/// part of the last step, from its start, with a single step of the required length. So a state
/// inside a step has the method's own order.
template <class Solver>
class OneStepIntegrator final : public Integrator {
 public:
  template <class Ode>
  OneStepIntegrator(Ode& ode, const IntegratorOptions& options)
      : OneStepIntegrator(make_context(), ode, options) {}

  void restart(double t, const State& y) override {
    main_.reset(t, y);
    stand_at(t, y);
  }
  void limit_next_step(double longest) override {
    if (!has_fixed_steps_) main_.limit_first_step(longest);
  }

  void step() override {
    const double reached = main_.step();
    // The library goes on even where a step no longer moves the time; the bound is nystrom's.
    if (!main_.root() &&
        !(reached - t1_ > 16.0 * std::numeric_limits<double>::epsilon() * std::abs(t1_))) {
      throw IntegrationFailure(t1_, "ARKODE", "step size too small",
                               "the step has shrunk to the rounding of the time");
    }
    std::swap(y0_, y1_);
    main_.read(y1_);
    main_.drain_root();
    t0_ = t1_;
    t1_ = reached;
    ++work_.steps;
  }

  void state_at(double t, State& y) override {
    if (t == t0_) {  // to the library a fixed step of zero means an adaptive one
      y = y0_;
      return;
    }
    partial_.set_fixed_step(t - t0_);
    partial_.reset(t0_, y0_);
    partial_.step();
    partial_.read(y);
    ++work_.partial_steps;
  }

  std::optional<Root> root() const override { return main_.root(); }

  WorkCounts work() const override {
    WorkCounts counts = work_;
    main_.add_counts(counts);
    partial_.add_counts(counts);
    return counts;
  }

 private:
  template <class Ode>
  OneStepIntegrator(const ContextPointer& context, Ode& ode, const IntegratorOptions& options)
      : has_fixed_steps_(options.fixed_step),
        main_(ode, options, context),
        partial_(ode, as_partial(options), context) {}

  static IntegratorOptions as_partial(IntegratorOptions options) {
    options.fixed_step = options.fixed_step.value_or(1.0);  // set anew before every use
    options.max_step.reset();
    options.event_functions.reset();
    return options;
  }

  bool has_fixed_steps_;
  Solver main_;
  Solver partial_;
};

}  // namespace

std::unique_ptr<Integrator> make_arkode_erk(SecondOrderOde& ode, const IntegratorOptions& options) {
  return std::make_unique<OneStepIntegrator<ErkSolver>>(ode, options);
}

std::unique_ptr<Integrator> make_arkode_dirk(MechanicalSystem& system,
                                             const IntegratorOptions& options) {
  return std::make_unique<OneStepIntegrator<ArkSolver>>(system, options);
}

}  // namespace subimpact
