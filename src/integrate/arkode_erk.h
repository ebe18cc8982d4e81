#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "integrate/coefficient_table.h"
#include "ode/integrator.h"

namespace subimpact {

/// The explicit embedded tables, in the order in which users see them; the first is the default.
const std::vector<CoefficientTable>& explicit_tables();

/// Which vector operations SUNDIALS runs on. Debian's library is compiled without optimisation, so
/// the project brings its own; the library's stay selectable for the comparison.
enum class VectorOperations { project, library };

struct ErkOptions {
  std::string table = "dop853";
  double relative_tolerance = 1e-8;
  std::optional<double> fixed_step;  ///< s; adaptive if empty
  std::optional<double> max_step;    ///< s
  VectorOperations vector_operations = VectorOperations::project;
};

/// SUNDIALS ARKODE's explicit Runge-Kutta methods on y' = [v, a(q)].
///
/// Weighted root-mean-square error control with the constant weights 1/(rtol * scale), scale being
/// the problem's position or velocity scale. A state inside the last step is a retaken, shorter
/// step of a second solver that has the same table (order of the method; ARKODE's dense output
/// stops at five). Tables whose last stage is not the next step's first are given such a stage,
/// which ERKStep of SUNDIALS before 6.7 needs to keep their order. Throws std::invalid_argument for
/// an unknown table.
std::unique_ptr<Integrator> make_arkode_erk(SecondOrderOde& ode, const ErkOptions& options);

}  // namespace subimpact
