#pragma once

/// Random scenes whose event times carry errors of the mesh, and the finer runs that reveal these.

#include <cstdint>
#include <vector>

#include "subimpact/case/case.h"

namespace subimpact::within_study {

struct DrawnScene {
  Case input;               ///< the run whose error bars are judged
  std::vector<Case> finer;  ///< the runs that take its place as the truth, from coarse to fine
  /// Whether `finer` goes on from the run's own mesh, so that the three show an order.
  bool same_mesh = false;
  int order = 2;  ///< at which `finer` converges
};

/// What is drawn from.
struct Kind {
  bool shears = false;  ///< all beams of Timoshenko's theory, on cells and spectral elements
};

/// What a scene's finest run may take, roughly.
struct Budget {
  double seconds = 12.0;
};

/// Seed and number determine the scene. All ends, strikes, contact laws and theories; two in five
/// beams are elastic. Cells (201 to 8001) by central differences, elements (40 to 800) by
/// `exponential` (elastic) or `nystrom`. A scene with fewer than four sub-impacts on 151 cells is
/// drawn again; one with more than twelve ends after them.
DrawnScene draw(std::uint64_t seed, int number, const Budget& budget, Kind kind = {});

}  // namespace subimpact::within_study
