#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "subimpact/model/mesh/beam_mesh.h"

namespace subimpact {

/// The nodes of a mesh of elements, and which unknowns they have: node by node the displacement w
/// and the rotation, but what supports hold (w at a pinned end, both at a clamped one, the rotation
/// in the middle of a half model). Between two of them an element may have inner nodes.
///
/// There is a node at the strike; to its left and right the numbers of elements share n as the
/// strike shares the length. Elements are equal on either side.
struct ElementNodes {
  /// In place of the index of an unknown that a support holds.
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// Indices of a node's unknowns.
  struct Node {
    std::size_t displacement, rotation;
  };

  /// `position` is the struck point as a fraction of the length, `n_elements` counts those of the
  /// whole beam, of which a `half` has one half; `degree` is the number of nodes that an element
  /// has to itself. Throws std::invalid_argument for fewer than `fewest` elements, a strike on a
  /// support, a half of an odd number, of unlike ends, struck off mid-span.
  ElementNodes(const Beam& beam, double position, std::size_t n_elements, std::size_t fewest,
               bool half, std::size_t degree);

  std::size_t n_elements() const { return lengths.size(); }  ///< of the part modelled
  std::size_t n_elements_whole() const { return half ? 2 * n_elements() : n_elements(); }

  bool half;
  std::array<EndSupport, 2> ends;
  std::size_t n_before = 0;     ///< elements to the left of the strike
  std::vector<double> lengths;  ///< of the elements, m
  std::vector<Node> nodes;
  std::size_t n_unknowns = 0;

 private:
  void place(double left_length, double right_length, std::size_t n_elements);
  void number_unknowns(std::size_t n_nodes);
};

/// A mesh of elements with a node at the strike. Displacements are unknowns themselves.
class ElementMesh : public BeamMesh {
 protected:
  static constexpr std::size_t none = ElementNodes::none;

  /// With what the nodes decide: struck point, first end and translation.
  ElementMesh(const Beam& beam, ElementNodes nodes, std::size_t degree, std::size_t half_bandwidth);

  ElementNodes nodes_;
};

}  // namespace subimpact
