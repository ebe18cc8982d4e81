#pragma once

namespace subimpact {

/// Neighbouring sections whose plastic curvature has one sign: a plastic hinge of some extent.
struct PlasticZone {
  double from, to;  ///< m, of the stretch for which the sections stand
  double rotation;  ///< rad: the integral of the plastic curvature
};

}  // namespace subimpact
