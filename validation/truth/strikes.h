#pragma once

/// Random strikes whose event times carry errors of the mesh, and the finer runs that reveal these.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "subimpact/case/case.h"

namespace subimpact::strikes {

struct DrawnScene {
  Case input;               ///< the run whose errors are judged
  std::vector<Case> finer;  ///< the runs that take its place as the truth, from coarse to fine
  int order = 2;            ///< at which `finer` converges
};

/// What is drawn from.
struct Kind {
  bool shears = false;  ///< all beams of Timoshenko's theory, on cells and spectral elements
  /// Light strikers, strikes near an end and damping too; meshes of at most 801 cells; for beams
  /// that yield, `finer` is four and eight times as fine in place of twice and four times.
  bool hard = false;
  /// Sub-impacts on 151 cells: a scene with fewer is drawn again, one with more ends after the
  /// most.
  std::size_t fewest = 4, most = 12;
};

/// What a scene's finest run may take, roughly.
struct Budget {
  double seconds = 12.0;
};

/// Seed, number and kind determine the scene. All ends, strikes, contact laws and theories; two in
/// five beams are elastic. Cells (201 to 8001; hard: 151 to 801) by central differences, elements
/// (40 to 800) by `exponential` (elastic) or `nystrom`.
DrawnScene draw(std::uint64_t seed, int number, const Budget& budget, const Kind& kind = {});

}  // namespace subimpact::strikes
