#pragma once

namespace subimpact {

/// Elements that are shorter near the strike: at the strike `refinement` times shorter than far
/// from it, and growing in proportion to the distance d over `refined_length`,
///
///     size(d) ~ 1/r + (1 - 1/r) d/refined_length for d < refined_length, else 1,  r = refinement.
///
/// There neighbours grow by a constant ratio. Twice as many elements halve every one, so a finer
/// mesh of the same grading holds all nodes of the coarser. A refinement of 1: equal elements.
struct ElementGrading {
  double refinement = 1.0;      ///< 1 or above
  double refined_length = 0.0;  ///< m, above 0 where refinement is above 1

  /// Integral of dx/size from the strike to the distance d: how many elements lie there, in units
  /// of the size far from the strike, m.
  double elements_within(double d) const;
  /// The distance d that holds so many: the inverse, m.
  double distance_of(double elements) const;
};

}  // namespace subimpact
