#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ode/integrator.h"

namespace subimpact {

/// A table of Runge-Kutta coefficients, or a pair of tables, as users see it.
struct CoefficientTable {
  std::string name;
  int order = 0;
  int embedded_order = 0;  ///< of the method whose difference is the error estimate
  int evaluations = 0;     ///< right-hand sides per accepted step; of an implicit table its stages
  std::string note;        ///< its source and what it is for
};

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
