#pragma once

#include "system/struck_beam.h"

namespace subimpact {

/// How stiff the contact can become, and what follows for time steps.
struct ContactResonance {
  double largest_slope;   ///< dF/dlambda, N/m: the largest that the strike's energy allows
  double effective_mass;  ///< kg: 1/m_eff = 1/m + S^T Mass^-1 S, of what the contact moves at once
  double highest_frequency;  ///< rad/s, of beam and striker joined by a spring of that slope
  double contact_time;  ///< s, (m_eff/(K v^(n-1)))^(1/(n+1)): the scale of the shortest contacts
};

/// The contact adds the rank-one stiffness k d d^T with d = (-S, 1) to the beam's. It moves only
/// modes in the Krylov space that Mass^-1 d spans, so Lanczos' method started there finds the one
/// that it lifts above the beam's own frequencies. `largest_indentation` (m) bounds the slope where
/// the energy does not.
ContactResonance contact_resonance(const StruckBeam& beam, double largest_indentation);

}  // namespace subimpact
