#pragma once

#include <memory>
#include <vector>

#include "integrate/coefficient_table.h"
#include "integrate/options.h"
#include "ode/integrator.h"

namespace subimpact {

/// The explicit embedded tables, in the order in which users see them; the first is the default.
const std::vector<CoefficientTable>& explicit_tables();

/// SUNDIALS ARKODE's explicit Runge-Kutta methods on y' = [v, a(q)].
///
/// Weighted root-mean-square error control with the constant weights 1/(rtol * scale), scale being
/// the problem's position or velocity scale. A state inside the last step is a retaken, shorter
/// step of a second solver that has the same table (order of the method; ARKODE's dense output
/// stops at five). Tables whose last stage is not the next step's first are given such a stage,
/// which ERKStep of SUNDIALS before 6.7 needs to keep their order. Throws std::invalid_argument for
/// an unknown table.
std::unique_ptr<Integrator> make_arkode_erk(SecondOrderOde& ode, const IntegratorOptions& options);

}  // namespace subimpact
