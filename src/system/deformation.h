#pragma once

#include <vector>

#include "system/struck_beam.h"

namespace subimpact {

/// How far a beam leaves its straight shape, by the states that are shown to it: the largest
/// rotation of a section (rad), at some stations along the beam, and the largest displacement of
/// the struck point (m). A mesh that gives no rotations has no stations.
class Deformation {
 public:
  /// `length`: of the whole beam, m. `beam` must outlive this.
  Deformation(const StruckBeam& beam, double length);

  void include(const State& y);
  void include_displacement(double of_struck_point);

  double largest_rotation() const { return largest_rotation_; }
  double largest_displacement() const { return largest_displacement_; }

 private:
  const StruckBeam& beam_;
  std::vector<SparseFunctional> rotations_;
  double largest_rotation_ = 0.0;
  double largest_displacement_ = 0.0;
};

}  // namespace subimpact
