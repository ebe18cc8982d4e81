#pragma once

#include <memory>

#include "integrate/options.h"
#include "ode/integrator.h"

namespace subimpact {

/// The highest orders of CVODE.
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
/// (with gamma C beside the mass on the left where forces depend on velocities), which stays
/// sparse: KLU factors it, its pattern analysed once.
std::unique_ptr<Integrator> make_cvode_bdf(MechanicalSystem& system,
                                           const IntegratorOptions& options);

}  // namespace subimpact
