#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "subimpact/model/scene.h"

namespace subimpact {

/// Elements that are shorter near the strike: at the strike `refinement` times shorter than far
/// from it, and growing in proportion to the distance d over `refined_length` (docs/theory.md,
/// "Hermite elements"). Twice as many elements halve every one.
struct ElementGrading {
  double refinement = 1.0;      ///< 1 or above
  double refined_length = 0.0;  ///< m, above 0 where refinement is above 1

  /// Integral of dx/size from the strike to the distance d: how many elements lie there, in units
  /// of the size far from the strike, m.
  double elements_within(double d) const;
  /// The distance d that holds so many: the inverse, m.
  double distance_of(double elements) const;
};

/// Where the nodes of a mesh of cubic Hermite elements lie, and which unknowns they have: node by
/// node the displacement w and the slope, but what supports hold (w at a pinned end, both at a
/// clamped one, the slope in the middle of a half model). At a hinge: slope before, w, slope after.
///
/// There is a node at the strike; to its left and right the numbers of elements share n as the
/// strike shares the length. Elements are equal on either side, or graded towards the strike.
struct HermiteNodes {
  struct Options {
    ElementGrading grading;
    bool hinges = false;  ///< one at the strike, and one at each clamped end
  };

  static constexpr std::size_t fewest_elements = 4;
  /// In place of the index of an unknown that a support holds.
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// Indices of a node's unknowns. The slopes are one but at a hinge.
  struct Node {
    std::size_t displacement, slope_before, slope_after;
  };

  /// `position` is the struck point as a fraction of the length, `n_elements` counts those of the
  /// whole beam, of which a `half` has one half. Throws std::invalid_argument for fewer than 4
  /// elements, a strike on a support, a half of an odd number of elements, of unlike ends or struck
  /// off mid-span.
  HermiteNodes(const Beam& beam, double position, std::size_t n_elements, bool half,
               const Options& options);

  std::size_t n_elements() const { return lengths.size(); }  ///< of the part modelled
  std::size_t n_elements_whole() const { return half ? 2 * n_elements() : n_elements(); }
  const Node& struck_node() const { return nodes[struck]; }
  bool is_hinge(std::size_t node) const;
  /// Of displacement and slope at the left node, then at the right one.
  std::array<std::size_t, 4> unknowns_of(std::size_t element) const;
  /// The element that contains x (m), and where in it, from 0 to 1.
  std::pair<std::size_t, double> element_at(double x) const;

  Options options;
  bool half;
  std::array<EndSupport, 2> ends;
  std::size_t struck = 0;       ///< index of the node under the strike
  std::vector<double> lengths;  ///< of the elements, m
  std::vector<Node> nodes;
  std::size_t n_unknowns = 0;

 private:
  void place(double left_length, double right_length, std::size_t n_elements);
  std::vector<double> lengths_of_side(std::size_t count, double length, double within) const;
  void number_unknowns();
};

}  // namespace subimpact
