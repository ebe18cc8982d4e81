#pragma once

#include <memory>
#include <vector>

#include "integrate/coefficient_table.h"
#include "integrate/options.h"
#include "ode/integrator.h"

namespace subimpact {

/// The implicit tables, and the pairs of an implicit and an explicit one, in the order in which
/// users see them; the first is the default.
const std::vector<CoefficientTable>& dirk_tables();
const std::vector<CoefficientTable>& imex_tables();

/// SUNDIALS ARKODE's diagonally implicit Runge-Kutta methods (ARKStep) on
///
///     [I, Mass] y' = [v, f(q)],   y = [q, v],
///
/// with the mass matrix as it is, sparse. Each stage solves (M - gamma J) dz = r by Newton's
/// method, J = [0, I; -K, 0] with the analytic tangent K, factored by KLU; the pattern is analysed
/// once. Error weights, restarts and states inside a step as in `erk`: the weights are constant, a
/// restart keeps the step size, a state inside the last step is a retaken, shorter step. With a
/// fixed step the tolerance still bounds the error of Newton's iteration. Throws
/// std::invalid_argument for a table that is not among dirk_tables().
std::unique_ptr<Integrator> make_arkode_dirk(MechanicalSystem& system,
                                             const IntegratorOptions& options);

/// The same with the right-hand side in two parts: [v, stiff part of f] taken implicitly,
/// [0, rest of f] explicitly, by a pair of tables that share their stages. The Newton matrix then
/// only changes where a section flows. Throws std::invalid_argument for a pair that is not among
/// imex_tables().
std::unique_ptr<Integrator> make_arkode_imex(MechanicalSystem& system,
                                             const IntegratorOptions& options);

}  // namespace subimpact
