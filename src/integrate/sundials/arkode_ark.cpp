#include "integrate/arkode_ark.h"

#include <arkode/arkode_arkstep.h>

#include <algorithm>

#include "integrate/sundials/block_system.h"
#include "integrate/sundials/butcher_tables.h"
#include "integrate/sundials/one_step_integrator.h"
#include "integrate/sundials/solver_frame.h"
#include "integrate/sundials/vector.h"

namespace subimpact {
namespace {

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

using Part = MechanicalSystem::Part;

constexpr int dense_output_degree = 4;

constexpr RootCalls root_calls = {ARK_ROOT_RETURN,         ARKStepRootInit,
                                  ARKStepSetRootDirection, ARKStepSetNoInactiveRootWarn,
                                  ARKStepGetRootInfo,      ARKStepGetCurrentTime,
                                  ARKStepGetLastStep};

class ArkSolver : private SolverFrame {
 public:
  ArkSolver(MechanicalSystem& system, const IntegratorOptions& options, SUNContext context,
            Part implicit_part)
      : SolverFrame(system, options, root_calls, context),
        system_(system),
        implicit_part_(implicit_part),
        y_(make_vector(2 * n_positions_, context, options.vector_operations)),
        matrices_(system, implicit_part, y_.get(), context) {
    N_VConst(0.0, y_.get());
    const ButcherTablePair tables = implicit_part == Part::all
                                        ? ButcherTablePair{load_dirk_table(options.table), nullptr}
                                        : load_imex_tables(options.table);
    const ARKRhsFn explicit_rate = implicit_part == Part::all ? nullptr : rate_of_rest;
    memory_.reset(ARKStepCreate(explicit_rate, implicit_rate, 0.0, y_.get(), context));
    void* memory = memory_.get();
    if (!memory) throw IntegrationFailure(0.0, "ARKStepCreate", "no memory", "");
    check(ARKStepSetUserData(memory, user_data()), "ARKStepSetUserData");
#if SUNDIALS_VERSION_MAJOR < 7
    check(ARKStepSetErrHandlerFn(memory, keep_message, user_data()), "ARKStepSetErrHandlerFn");
#endif
    check(ARKStepWFtolerances(memory, error_weights), "ARKStepWFtolerances");
    check(ARKStepSetTables(memory, tables.implicit->q, tables.implicit->p, tables.implicit.get(),
                           tables.explicit_part.get()),
          "ARKStepSetTables");
    check(ARKStepSetMassLinearSolver(memory, matrices_.mass_solver(), matrices_.mass_matrix(),
                                     SUNFALSE),
          "ARKStepSetMassLinearSolver");
    check(ARKStepSetMassFn(memory, mass), "ARKStepSetMassFn");
    check(ARKStepSetLinearSolver(memory, matrices_.newton_solver(), matrices_.newton_matrix()),
          "ARKStepSetLinearSolver");
    check(ARKStepSetLinSysFn(memory, newton_matrix), "ARKStepSetLinSysFn");
    if (roots_.is_on()) {
      // Lagrange interpolation would begin again at a low degree after every restart.
      check(ARKStepSetInterpolantType(memory, ARK_INTERP_HERMITE), "ARKStepSetInterpolantType");
      check(ARKStepSetInterpolantDegree(memory, dense_output_degree),
            "ARKStepSetInterpolantDegree");
    } else {
      // Dense output is not used, and Lagrange interpolation costs no evaluation.
      check(ARKStepSetInterpolantType(memory, ARK_INTERP_LAGRANGE), "ARKStepSetInterpolantType");
    }
    check(ARKStepSetMaxNumSteps(memory, -1), "ARKStepSetMaxNumSteps");
    check(ARKStepSetLSetupFrequency(memory, steps_per_matrix), "ARKStepSetLSetupFrequency");
    check(ARKStepSetJacEvalFrequency(memory, steps_per_matrix), "ARKStepSetJacEvalFrequency");
    check(ARKStepSetDeltaGammaMax(memory, largest_change_of_gamma), "ARKStepSetDeltaGammaMax");
    check(ARKStepSetMaxNonlinIters(memory, max_iterations), "ARKStepSetMaxNonlinIters");
    check(ARKStepSetNonlinCRDown(memory, fastest_fall_of_rate), "ARKStepSetNonlinCRDown");
    if (options.max_step) {
      check(ARKStepSetMaxStep(memory, *options.max_step), "ARKStepSetMaxStep");
    }
    if (options.fixed_step) set_fixed_step(*options.fixed_step);
  }

  void set_fixed_step(double step) {
    check(ARKStepSetFixedStep(memory_.get(), step), "ARKStepSetFixedStep");
  }

  void reset(double t, const State& y) {
    std::copy(y.begin(), y.end(), entries(y_.get()).begin());
    check(ARKStepReset(memory_.get(), t, y_.get()), "ARKStepReset");
    check(roots_.restart(memory_.get(), event_values, y), "ARKStepRootInit");
    time_ = t;
  }

  /// One step; returns the time reached.
  double step(State& y) {
    double reached = time_;
    const auto evolve = [&] {
      return ARKStepEvolve(memory_.get(), time_ahead(time_), y_.get(), &reached, ARK_ONE_STEP);
    };
    check(roots_.step(memory_.get(), reached, entries(y_.get()), evolve), "ARKStepEvolve");
    const auto values = entries(y_.get());
    std::copy(values.begin(), values.end(), y.begin());
    time_ = reached;
    roots_.drain(memory_.get(), reached, evolve);
    return time_;
  }
  const std::optional<Integrator::Root>& root() const { return roots_.root(); }

  void add_counts(WorkCounts& counts) const {
    long rejected = 0, mass_solves = 0, iterations = 0, failures = 0;
    ARKStepGetNumErrTestFails(memory_.get(), &rejected);
    ARKStepGetNumMassSolves(memory_.get(), &mass_solves);
    ARKStepGetNonlinSolvStats(memory_.get(), &iterations, &failures);
    counts.rejected_steps += rejected;
    counts.mass_solves += mass_solves;
    counts.nonlinear_iterations += iterations;
    counts.nonlinear_failures += failures;
    counts.right_hand_sides += right_hand_sides_;
    matrices_.add_counts(counts);
  }

 private:
  struct FreeMemory {
    void operator()(void* memory) const { ARKStepFree(&memory); }
  };

  static int implicit_rate(sunrealtype, N_Vector y, N_Vector rate, void* frame) {
    auto& self = static_cast<ArkSolver&>(of(frame));
    const std::size_t n = self.n_positions_;
    const auto in = entries(y);
    const auto out = entries(rate);
    ++self.right_hand_sides_;
    return self.guarded([&] {
      std::copy_n(in.begin() + static_cast<std::ptrdiff_t>(n), n, out.begin());
      self.system_.force(in, self.implicit_part_, out.subspan(n));
    });
  }

  static int rate_of_rest(sunrealtype, N_Vector y, N_Vector rate, void* frame) {
    auto& self = static_cast<ArkSolver&>(of(frame));
    const std::size_t n = self.n_positions_;
    const auto out = entries(rate);
    return self.guarded([&] {
      std::fill_n(out.begin(), n, 0.0);
      self.system_.force(entries(y), Part::rest, out.subspan(n));
    });
  }

  static int mass(sunrealtype, SUNMatrix matrix, void* frame, N_Vector, N_Vector, N_Vector) {
    auto& self = static_cast<ArkSolver&>(of(frame));
    return self.guarded([&] { self.matrices_.fill_mass(matrix); });
  }

  static int newton_matrix(sunrealtype, N_Vector y, N_Vector, SUNMatrix, SUNMatrix,
                           sunbooleantype keep_stiffness, sunbooleantype* updated,
                           sunrealtype gamma, void* frame, N_Vector, N_Vector, N_Vector) {
    auto& self = static_cast<ArkSolver&>(of(frame));
    *updated = keep_stiffness ? SUNFALSE : SUNTRUE;
    return self.guarded([&] {
      if (!keep_stiffness) self.matrices_.update_tangents(entries(y));
      self.matrices_.assemble(gamma);
    });
  }

  void check(int flag, const char* function) {
    SolverFrame::check(flag, function, ARKStepGetReturnFlagName);
  }

  MechanicalSystem& system_;
  Part implicit_part_;
  VectorPointer y_;
  BlockSystem matrices_;
  std::unique_ptr<void, FreeMemory> memory_;
};

}  // namespace

std::unique_ptr<Integrator> make_arkode_dirk(MechanicalSystem& system,
                                             const IntegratorOptions& options) {
  return std::make_unique<OneStepIntegrator<ArkSolver>>(system, options, Part::all);
}

std::unique_ptr<Integrator> make_arkode_imex(MechanicalSystem& system,
                                             const IntegratorOptions& options) {
  return std::make_unique<OneStepIntegrator<ArkSolver>>(system, options, Part::stiff);
}

}  // namespace subimpact
