#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "subimpact/model/natural_modes.h"
#include "subimpact/model/scene.h"

namespace subimpact {

/// A chain of equal Hermite elements (see HermiteMesh).
struct HermiteChain {
  std::size_t n_elements;    ///< of the whole chain
  double length;             ///< a of an element, m; also the unit of slopes
  double mass_per_length;    ///< rho A, kg/m
  double rotary_inertia;     ///< J, kg m
  double bending_stiffness;  ///< E I, N m2
  std::array<EndSupport, 2> ends;
  bool half;  ///< symmetric modes only, on the first half of the chain
};

/// Whether a chain with these ends has its modes in closed form.
constexpr bool has_closed_modes(std::array<EndSupport, 2> ends) {
  return ends[0] == ends[1] || ends[0] == EndSupport::pinned || ends[1] == EndSupport::pinned;
}

/// Its natural modes in closed form, without decomposing a matrix; work n^2 for n shapes.
///
/// From node to node the chain carries waves (W, Theta) z^j of displacement and slope. With A to E
/// the entries of an element's dynamic stiffness, all linear in lambda = omega^2 rho A a^4/(E I),
/// and p = 1 - (z + 1/z)/2 they exist where
///
///     (A + C - C p)(B + E - E p) = D^2 p (2 - p).
///
/// For given lambda that is a quadratic in p, for given p one in lambda. A wave number theta, p =
/// 2 sin^2(theta/2), has two frequencies: a beam's (acoustic branch) and, above a stop band, one at
/// which slopes of neighbours work against each other (optical). The other p at the same frequency
/// is negative, -2 sinh^2(phi/2): a wave that decays from the ends.
///
/// Each end gives two conditions on the two waves; at a free end they are taken as no force on and
/// no couple on a further element into which the waves go on. With m elements from the middle to
/// the ends that leaves
///
///     even modes: tan(theta m) = R tanh(phi m),   odd ones: tan(theta m) = -tanh(phi m)/R.
///
/// R(theta) keeps its sign within a branch, so theta m - atan(...) passes every multiple of pi
/// once: each mode has a bracket of its own and their number is known. Besides, a free end
/// has a mode of its own at the top of the optical branch or above all bands. A pinned end has
/// theta m = (k - 1/2) pi or k pi; next to another kind of end it is the middle of an odd mode.
///
/// Frequencies ascend, rigid modes first; shapes have the unknowns of a HermiteMesh and are not
/// normalised. Empty if one end is free and the other clamped, or if the number of modes found
/// should not be that of the unknowns: then decompose. As no two in a class are alike, the right
/// number means that none is missing.
std::optional<NaturalModes> hermite_chain_modes(const HermiteChain& chain);

}  // namespace subimpact
