#include "model/mesh/element_mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace subimpact {

ElementNodes::ElementNodes(const Beam& beam, double position, std::size_t n_elements,
                           std::size_t fewest, bool is_half, std::size_t degree)
    : half(is_half), ends(beam.ends) {
  if (n_elements < fewest) {
    throw std::invalid_argument("mesh of elements: at least " + std::to_string(fewest) +
                                " are needed");
  }
  if (half && (n_elements % 2 != 0 || position != 0.5 || ends[0] != ends[1])) {
    throw std::invalid_argument(
        "mesh of elements: a half model needs an even number, struck at 0.5, and ends alike");
  }
  place(position * beam.length, half ? 0.0 : (1.0 - position) * beam.length,
        half ? n_elements / 2 : n_elements);
  number_unknowns(degree * lengths.size() + 1);
  if (nodes[degree * n_before].displacement == none) {
    throw std::invalid_argument("mesh of elements: the strike is on a support");
  }
}

void ElementNodes::place(double left, double right, std::size_t n_elements) {
  n_before = n_elements;
  if (!half) {
    n_before = static_cast<std::size_t>(
        std::lround(static_cast<double>(n_elements) * left / (left + right)));
    if (left > 0.0) n_before = std::max<std::size_t>(n_before, 1);
    if (right > 0.0) n_before = std::min(n_before, n_elements - 1);
  }
  lengths.assign(n_before, left / static_cast<double>(n_before));
  lengths.resize(n_elements, right / static_cast<double>(n_elements - n_before));
}

void ElementNodes::number_unknowns(std::size_t n_nodes) {
  for (std::size_t i = 0; i < n_nodes; ++i) {
    const bool mirror = half && i + 1 == n_nodes;
    EndSupport support = EndSupport::free;
    if (i == 0) support = ends[0];
    if (i + 1 == n_nodes && !mirror) support = ends[1];
    Node& node = nodes.emplace_back(none, none);
    if (support == EndSupport::free) node.displacement = n_unknowns++;
    if (support != EndSupport::clamped && !mirror) node.rotation = n_unknowns++;
  }
}

ElementMesh::ElementMesh(const Beam& beam, ElementNodes nodes, std::size_t degree,
                         std::size_t half_bandwidth)
    : BeamMesh(nodes.n_unknowns, half_bandwidth, nodes.half), nodes_(std::move(nodes)) {
  beam_mass_ = beam.mass();
  struck_point_.terms = {{nodes_.nodes[degree * nodes_.n_before].displacement, 1.0}};
  if (nodes_.ends[0] == EndSupport::free) first_end_.terms = {{0, 1.0}};
  if (!beam.is_free()) return;
  translation_.assign(n_unknowns(), 0.0);
  for (const ElementNodes::Node& node : nodes_.nodes) translation_[node.displacement] = 1.0;
}

}  // namespace subimpact
