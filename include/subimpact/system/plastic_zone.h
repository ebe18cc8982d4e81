#pragma once

namespace subimpact {

/// Neighbouring sections whose plastic curvature has one sign: a plastic hinge of some extent.
struct PlasticZone {
  double from, to;  ///< m, positions of the outermost sections
  double rotation;  ///< rad: the integral of the plastic curvature
};

}  // namespace subimpact
