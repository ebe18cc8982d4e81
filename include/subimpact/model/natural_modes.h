#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "subimpact/numerics/banded_matrix.h"

namespace subimpact {

class BeamMesh;

/// All natural modes of a mesh, elastic: K phi = omega^2 Mass phi, phi^T Mass phi = 1.
struct NaturalModes {
  std::vector<double> frequencies;  ///< omega, rad/s, ascending; exactly 0 for rigid modes
  std::vector<double> shapes;       ///< mode k in entries k n .. k n + n - 1

  std::size_t size() const { return frequencies.size(); }
  std::span<const double> shape(std::size_t mode) const {
    return {shapes.data() + mode * size(), size()};
  }
  std::span<double> shape(std::size_t mode) { return {shapes.data() + mode * size(), size()}; }
};

/// Scales shapes so that phi^T Mass phi = 1.
void normalise(NaturalModes& modes, const BandedMatrix& mass);

/// By dense decomposition, for any mesh, and corrections that remove what its rounding mixes of low
/// modes; where sections shear, frequencies grow too slowly for that to matter. Frequencies are
/// Rayleigh quotients of B phi and the shear energy, which keeps the lowest of them accurate in
/// spite of the highest; those below 1e-7 of the highest count as rigid.
NaturalModes dense_natural_modes(const BeamMesh& mesh, double bending_stiffness);

}  // namespace subimpact
