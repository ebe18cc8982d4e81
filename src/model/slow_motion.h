#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "subimpact/model/beam_mesh.h"

namespace subimpact {

/// The lowest natural modes of a mesh, elastic, and its static response to a force at the struck
/// point.
struct SlowMotion {
  std::vector<double> frequencies;          ///< omega, rad/s, ascending; exactly 0 for rigid modes
  std::vector<std::vector<double>> shapes;  ///< phi^T Mass phi = 1
  /// u, m/N: K u = S - sum (S phi) Mass phi over the rigid modes, whose inertia balances the force.
  std::vector<double> response;

  std::size_t size() const { return frequencies.size(); }
};

/// `n_modes` of them, or all if there are fewer. By subspace iteration with a banded factorisation
/// of K + s Mass, s a part of the first frequency squared, in some n_modes n operations per unknown
/// of the band; from the modes themselves where the unknowns are modes. `first_period`: of the
/// beam in bending, roughly, s. Nothing if K + s Mass is not positive definite.
std::optional<SlowMotion> slow_motion(const BeamMesh& mesh, double bending_stiffness,
                                      double first_period, std::size_t n_modes);

}  // namespace subimpact
