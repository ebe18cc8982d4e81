#pragma once

namespace subimpact {

/// Neighbouring sections whose plastic curvature has one sign: a plastic hinge of some extent.
struct PlasticZone {
  double from, to;  ///< m, ends of the stretch that the sections represent
  double rotation;  ///< rad: the integral of the plastic curvature
};

}  // namespace subimpact
