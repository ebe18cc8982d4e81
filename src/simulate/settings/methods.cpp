#include "simulate/settings/methods.h"

#include <limits>
#include <stdexcept>

#include "integrate/central_difference.h"
#include "integrate/exponential.h"
#include "integrate/nystrom.h"
#include "integrate/sundials.h"
#include "system/flight/free_flight.h"
#include "system/modal_beam.h"

namespace subimpact {
namespace {

using IntegratorPointer = std::unique_ptr<Integrator>;

constexpr int usual_adams_order = 12;
// Orders above 2 are unstable on undamped oscillations, but only for steps that tolerances of 1e-7
// and below do not take; there order 5 is 20 times as accurate as order 2 at a quarter of the cost.
constexpr int usual_bdf_order = 5;

// Where the beam may yield only free flight has a closed form; nystrom does the rest.
IntegratorPointer make_exponential(StruckBeam& beam, const IntegratorOptions& options) {
  if (beam.sections().can_yield()) {
    // Under loads free flight is no motion of free oscillators.
    if (!beam.loads().is_empty()) return std::make_unique<Nystrom>(beam, options);
    return std::make_unique<FreeFlight>(
        std::make_unique<Nystrom>(beam, options), beam,
        options.max_step.value_or(std::numeric_limits<double>::infinity()));
  }
  return std::make_unique<Exponential>(std::make_unique<ModalBeam>(beam), options);
}

std::vector<MethodDescriptor> make_descriptors() {
  using Steps = MethodDescriptor::Steps;
  using Modes = MethodDescriptor::Modes;
  using Damping = MethodDescriptor::Damping;
  return {
      {.kind = Method::central_difference,
       .name = "central-difference",
       .note = "explicit, second order, fixed step: the scheme of the published runs",
       .steps = Steps::fixed,
       .modes = Modes::where_cheaper,
       .events = EventHandling::interpolated,
       .audit_interval = 256,
       .make =
           [](StruckBeam& beam, const IntegratorOptions& options) {
             return std::make_unique<CentralDifference>(beam, *options.fixed_step,
                                                        options.constant_force_on_last);
           }},
      {.kind = Method::erk,
       .name = "erk",
       .note = "explicit Runge-Kutta with error control (ARKODE): the default, for accurate event "
               "times",
       .sundials = true,
       .modes = Modes::where_cheaper,
       .damping = Damping::any,
       .tables = explicit_tables,
       .make = make_arkode_erk},
      {.kind = Method::nystrom,
       .name = "nystrom",
       .note = "explicit Runge-Kutta-Nystroem with error control: erk's accuracy at a fraction of "
               "its cost",
       .modes = Modes::where_cheaper,
       .tables =
           [] {
             const auto& tables = nystrom_tables();
             return std::vector<CoefficientTable>(tables.begin(), tables.end());
           },
       .make =
           [](StruckBeam& beam, const IntegratorOptions& options) {
             return std::make_unique<Nystrom>(beam, options);
           }},
      {.kind = Method::exponential,
       .name = "exponential",
       .note = "natural modes: an elastic beam under a collocated contact force, free flight in "
               "closed form where it yields; the fastest",
       .modes = Modes::always,
       .needs_located_events = true,
       .needs_adaptive_steps_to_yield = true,
       .damping = Damping::of_modes,
       .make = make_exponential},
      {.kind = Method::dirk,
       .name = "dirk",
       .note = "diagonally implicit Runge-Kutta with error control (ARKODE): stable at any step, "
               "but damps what it does not resolve",
       .implicit = true,
       .sundials = true,
       .damping = Damping::any,
       .audit_interval = 4,
       .tables = dirk_tables,
       .make = make_arkode_dirk},
      // To a multistep method a restart at each reversal costs more than the reversal's error.
      {.kind = Method::adams,
       .name = "adams",
       .note = "Adams-Moulton of variable order (CVODE): two evaluations per step; for tolerances "
               "of 1e-7 and below",
       .steps = Steps::adaptive_order,
       .sundials = true,
       .damping = Damping::any,
       .reversals = ReversalHandling::step_end,
       .audit_interval = 64,
       .order = {{adams_order_limit, usual_adams_order}},
       .make = make_cvode_adams},
      {.kind = Method::bdf,
       .name = "bdf",
       .note = "backward differentiation (CVODE): for tolerances of 1e-7 and below; at looser "
               "tolerances orders above 2 (solver.max_order) blow up, as they do on any undamped "
               "oscillation",
       .steps = Steps::adaptive_order,
       .sundials = true,
       .damping = Damping::any,
       .reversals = ReversalHandling::step_end,
       .audit_interval = 64,
       .order = {{bdf_order_limit, usual_bdf_order}},
       .make = make_cvode_bdf},
      {.kind = Method::own,
       .name = "own",
       .note = "an integrator of the caller's own, of a program that uses the library "
               "(examples/own_integrator.cpp)",
       .modes = Modes::where_cheaper,
       .damping = Damping::any},
  };
}

}  // namespace

const std::vector<MethodDescriptor>& methods() {
  static const std::vector<MethodDescriptor> list = make_descriptors();
  return list;
}

const MethodDescriptor& descriptor_of(Method method) {
  for (const MethodDescriptor& descriptor : methods()) {
    if (descriptor.kind == method) return descriptor;
  }
  throw std::logic_error("a method has no descriptor: add a row in methods.cpp");
}

EventHandling events_of(const Options& input) {
  return input.solver.events.value_or(descriptor_of(input.solver.method).events);
}

ReversalHandling reversals_of(const Options& input) {
  return input.solver.reversals.value_or(descriptor_of(input.solver.method).reversals);
}

const std::vector<MethodTable>& method_tables() {
  static const std::vector<MethodTable> tables = [] {
    std::vector<MethodTable> list;
    for (const MethodDescriptor& descriptor : methods()) {
      if (!descriptor.tables) continue;
      for (const CoefficientTable& table : descriptor.tables()) {
        list.push_back({descriptor.kind, table.name, table.order, table.embedded_order,
                        table.evaluations, table.note});
      }
    }
    return list;
  }();
  return tables;
}

}  // namespace subimpact
