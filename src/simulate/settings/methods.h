#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "integrate/options.h"
#include "ode/integrator.h"
#include "subimpact/simulate/options.h"
#include "system/struck_beam.h"

namespace subimpact {

/// All that the program has to decide by method, in one row per method. A new method is its own
/// files, an enumerator of Method and a row in methods.cpp.
struct MethodDescriptor {
  Method kind;
  const char* name;  ///< in case files
  const char* note;  ///< what it is for

  enum class Steps {
    fixed,           ///< a fixed step, derived from the critical one if none is given
    adaptive,        ///< adaptive, or fixed where solver.step is given
    adaptive_order,  ///< step and order chosen together: no fixed step
  };
  Steps steps = Steps::adaptive;
  bool has_fixed_steps() const { return steps == Steps::fixed; }
  bool implicit = false;  ///< solves equations to the tolerance, whatever the step
  bool sundials = false;  ///< by SUNDIALS, with its root-finding and vector operations

  /// Whether an elastic beam is integrated in its natural modes.
  enum class Modes {
    never,
    where_cheaper,  ///< where BeamMesh::prefers_modes()
    always
  };
  Modes modes = Modes::never;

  /// What the method cannot do at all, and what it cannot do where the beam may yield.
  bool needs_located_events = false;
  bool needs_adaptive_steps_to_yield = false;

  /// Forces of damping that the method can integrate.
  enum class Damping {
    none,      ///< the scheme needs q'' = a(q)
    of_modes,  ///< of an elastic beam, mode by mode in closed form
    any
  };
  Damping damping = Damping::none;

  EventHandling events = EventHandling::located;           ///< default
  ReversalHandling reversals = ReversalHandling::located;  ///< default
  long audit_interval = 32;  ///< steps between two full checks of energy and momentum

  struct Order {
    int limit;
    int usual;  ///< default of solver.max_order
  };
  std::optional<Order> order = {};  ///< of multistep methods

  /// Coefficients that solver.table may name, the default first; none for a method without tables.
  std::function<std::vector<CoefficientTable>()> tables = {};
  std::function<std::unique_ptr<Integrator>(StruckBeam&, const IntegratorOptions&)> make = {};
};

const std::vector<MethodDescriptor>& methods();
const MethodDescriptor& descriptor_of(Method method);

/// The default fixed step, and the largest of refined runs and sweeps, over the critical step.
constexpr double default_part_of_critical = 0.9;

/// The given value or, if none is given, the default of the method.
EventHandling events_of(const Options& options);
ReversalHandling reversals_of(const Options& options);

}  // namespace subimpact
