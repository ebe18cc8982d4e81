#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ode/event_functions.h"

namespace subimpact {

/// Which vector operations SUNDIALS runs on. Debian's library is compiled without optimisation, so
/// the project brings its own; the library's stay selectable for the comparison.
enum class VectorOperations { project, library };

/// Settings of an integrator. A method leaves out those that it does not have.
struct IntegratorOptions {
  double relative_tolerance = 1e-8;
  std::optional<double> fixed_step = {};  ///< s; adaptive if empty
  std::optional<double> max_step = {};    ///< s
  std::string table = {};                 ///< of Runge-Kutta methods; empty: the method's first
  int max_order = 0;                      ///< of multistep methods, from 1 to the method's limit
  bool constant_force_on_last = false;    ///< of central differences: see CentralDifference
  VectorOperations vector_operations = VectorOperations::project;  ///< of methods of SUNDIALS
  /// Whose roots end steps, of methods of SUNDIALS; none: no root-finding.
  std::shared_ptr<const EventFunctions> event_functions = {};
};

}  // namespace subimpact
