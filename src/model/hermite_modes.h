#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "subimpact/model/beam_mesh.h"
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

/// Its natural modes in closed form (docs/theory.md, "Hermite elements"); work n^2 for n shapes. A
/// free end is taken as no force on and no couple on a further element into which the waves go on.
///
/// Frequencies ascend, rigid modes first; shapes have the unknowns of a HermiteMesh and are not
/// normalised. Empty if one end is free and the other clamped, or if the number of modes found
/// should not be that of the unknowns: then decompose.
std::optional<NaturalModes> hermite_chain_modes(const HermiteChain& chain);

}  // namespace subimpact
