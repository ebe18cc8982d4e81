#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "subimpact/model/mesh/beam_mesh.h"
#include "subimpact/model/scene.h"
#include "system/contact/contact_state.h"

namespace subimpact {

/// A spring that only pushes (Spring::one_sided) as a contact of its own, between one point of the
/// beam and the ground: its indentation is d = a.w - gap, with the displacement a.w of that point
/// towards it; the force on the beam is -F(d, d') a.
struct LiftingSupport {
  std::size_t spring;         ///< its number in Beam::springs, from 0
  double position;            ///< x, m
  double sense;               ///< 1: behind the beam; -1: before it
  double gap;                 ///< m
  double copies;              ///< 2 where its mirror image is folded in
  SparseFunctional approach;  ///< a
  ContactState contact;
  /// m: it touches or lifts only where the indentation passes zero by more, so that rounding is no
  /// event, be it that of a beam that touches without force.
  double dead_length;
  double impulse = 0.0;  ///< N s, of its force since the start

  double indentation(std::span<const double> unknowns) const { return approach(unknowns) - gap; }
  double stiffness() const { return contact.law().scales().stiffness; }
  std::size_t half_bandwidth() const;  ///< of a a^T
};

/// Those of a beam on a mesh, of half a beam those of one half. `length_scale` (m): of the strike.
/// Throws std::invalid_argument for a mesh without displacements at their points.
std::vector<LiftingSupport> lifting_supports(const BeamMesh& mesh, const Beam& beam,
                                             double length_scale);

}  // namespace subimpact
