#pragma once

#include <complex>
#include <memory>
#include <string>
#include <vector>

#include "integrate/options.h"

namespace subimpact {

std::string sundials_version();  ///< of the library that runs
std::string klu_version();       ///< of the headers compiled against

/// The tables of Runge-Kutta coefficients, in the order in which users see them: explicit embedded
/// ones and implicit ones; the first is the default.
const std::vector<CoefficientTable>& explicit_tables();
const std::vector<CoefficientTable>& dirk_tables();

/// SUNDIALS ARKODE's explicit Runge-Kutta methods on y' = [v, a(q)].
///
/// Weighted root-mean-square error control with the constant weights 1/(rtol * scale), scale being
/// the problem's position or velocity scale. A state inside the last step is a retaken, shorter
/// step of a second solver that has the same table (order of the method; ARKODE's dense output
/// stops at five). Tables whose last stage is not the next step's first are given such a stage,
/// which ERKStep of SUNDIALS before 6.7 needs to keep their order. Throws std::invalid_argument for
/// an unknown table.
std::unique_ptr<Integrator> make_arkode_erk(SecondOrderOde& ode, const IntegratorOptions& options);

/// SUNDIALS ARKODE's diagonally implicit Runge-Kutta methods (ARKStep) on
///
///     [I, Mass] y' = [v, f(q)],   y = [q, v],
///
/// with the mass matrix as it is, sparse. Each stage is solved by Newton's method with the analytic
/// tangent K, factored by KLU (see BlockSystem). Error weights and states inside a step as in
/// `erk`; a restart keeps the step size. With a fixed step the tolerance still bounds the error of
/// Newton's iteration. Throws std::invalid_argument for a table that is not among dirk_tables().
std::unique_ptr<Integrator> make_arkode_dirk(MechanicalSystem& system,
                                             const IntegratorOptions& options);

constexpr int adams_order_limit = 12;
constexpr int bdf_order_limit = 5;

/// SUNDIALS CVODE's multistep methods on y' = [v, a(q)], order and step chosen by error control
/// with the constant weights of `erk`.
///
/// A state inside the last step comes from the method's own polynomial (CVodeGetDky), with the
/// order of the method. A restart (CVodeReInit) discards the past steps of a multistep method: it
/// begins again at order one with an estimated step, and raises both. There is no fixed step.
/// Adams-Moulton, orders 1 to 12, corrected by fixed-point iteration; no matrices. For accuracy,
/// not for long steps: the iteration converges for omega h below about 1, and orders above 2 let
/// undamped oscillations grow at steps that tolerances looser than 1e-6 choose.
std::unique_ptr<Integrator> make_cvode_adams(SecondOrderOde& ode, const IntegratorOptions& options);

/// Backward differentiation formulas, orders 1 to 5, corrected by Newton's method. On an undamped
/// oscillation of frequency omega, order 2 is stable for every step but damps; from order 3 on the
/// oscillation grows over a range of steps (order 3: omega h up to 1.94; order 5: 0.71 to 9.39),
/// and a beam's spectrum always has frequencies in it.
///
/// CVODE has no mass matrix, so the right-hand side solves with the mass, and Newton's system
/// (I - gamma J) x = b, J = [0, I; -Mass^-1 K, 0], is solved as
///
///     (Mass + gamma^2 K) x2 = Mass b2 - gamma K b1,   x1 = b1 + gamma x2,
///
/// (with gamma C added to the mass on the left where forces depend on velocities), which stays
/// sparse: KLU factors it, its pattern analysed once.
std::unique_ptr<Integrator> make_cvode_bdf(MechanicalSystem& system,
                                           const IntegratorOptions& options);

/// R(z) of an explicit or diagonally implicit Runge-Kutta table: y' = lambda y goes from y to R(h
/// lambda) y in one step. On an undamped oscillation, |R(i omega h)| is the growth of its
/// amplitude. Throw std::invalid_argument for an unknown table.
std::complex<double> explicit_stability(const std::string& table, std::complex<double> z);
std::complex<double> dirk_stability(const std::string& table, std::complex<double> z);

}  // namespace subimpact
