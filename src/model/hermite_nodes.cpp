#include "model/hermite_nodes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace subimpact {

double ElementGrading::elements_within(double d) const {
  if (refinement == 1.0) return d;
  const double growth = (1.0 - 1.0 / refinement) / refined_length;  // of the size, a metre
  if (d <= refined_length) return std::log1p(growth * refinement * d) / growth;
  return std::log(refinement) / growth + (d - refined_length);
}

double ElementGrading::distance_of(double elements) const {
  if (refinement == 1.0) return elements;
  const double growth = (1.0 - 1.0 / refinement) / refined_length;
  const double within_refined = std::log(refinement) / growth;
  if (elements <= within_refined) return std::expm1(growth * elements) / (growth * refinement);
  return refined_length + (elements - within_refined);
}

HermiteNodes::HermiteNodes(const Beam& beam, double position, std::size_t n_elements, bool is_half,
                           const Options& chosen)
    : options(chosen), half(is_half), ends(beam.ends) {
  if (n_elements < fewest_elements) {
    throw std::invalid_argument("hermite mesh: at least 4 elements are needed");
  }
  if (half && (n_elements % 2 != 0 || position != 0.5 || ends[0] != ends[1])) {
    throw std::invalid_argument(
        "hermite mesh: a half model needs an even number of elements, struck at 0.5, and ends "
        "alike");
  }
  place(position * beam.length, half ? 0.0 : (1.0 - position) * beam.length,
        half ? n_elements / 2 : n_elements);
  number_unknowns();
  if (struck_node().displacement == none) {
    throw std::invalid_argument("hermite mesh: the strike is on a support");
  }
}

// Left and right of the strike, nodes are equidistant in elements_within.
void HermiteNodes::place(double left_length, double right_length, std::size_t n_elements) {
  const double left = options.grading.elements_within(left_length);
  const double right = options.grading.elements_within(right_length);
  struck = n_elements;
  if (!half) {
    struck = static_cast<std::size_t>(
        std::lround(static_cast<double>(n_elements) * left / (left + right)));
    if (left > 0.0) struck = std::max<std::size_t>(struck, 1);
    if (right > 0.0) struck = std::min(struck, n_elements - 1);
  }
  lengths = lengths_of_side(struck, left_length, left);
  std::reverse(lengths.begin(), lengths.end());
  const auto after = lengths_of_side(n_elements - struck, right_length, right);
  lengths.insert(lengths.end(), after.begin(), after.end());
}

// From the strike outwards.
std::vector<double> HermiteNodes::lengths_of_side(std::size_t count, double length,
                                                  double within) const {
  std::vector<double> side(count, length / static_cast<double>(count));
  if (options.grading.refinement == 1.0) return side;
  double before = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i + 1) / static_cast<double>(count);
    const double d = i + 1 == count ? length : options.grading.distance_of(within * share);
    side[i] = d - before;
    before = d;
  }
  return side;
}

bool HermiteNodes::is_hinge(std::size_t node) const {
  if (!options.hinges) return false;
  const bool mirror = half && node == n_elements();
  if (mirror || (node > 0 && node < n_elements())) return node == struck;
  return ends[node == 0 ? 0 : 1] == EndSupport::clamped;
}

void HermiteNodes::number_unknowns() {
  std::size_t next = 0;
  for (std::size_t i = 0; i <= n_elements(); ++i) {
    const bool mirror = half && i == n_elements();
    EndSupport support = EndSupport::free;
    if (i == 0) support = ends[0];
    if (i == n_elements() && !mirror) support = ends[1];
    Node node{none, none, none};
    const bool hinge = is_hinge(i);
    if (hinge && i > 0) node.slope_before = next++;
    if (support == EndSupport::free) node.displacement = next++;
    if (hinge) {
      if (i < n_elements()) node.slope_after = next++;
    } else if (support != EndSupport::clamped && !mirror) {
      node.slope_before = node.slope_after = next++;
    }
    nodes.push_back(node);
  }
  n_unknowns = next;
}

std::array<std::size_t, 4> HermiteNodes::unknowns_of(std::size_t element) const {
  const Node& left = nodes[element];
  const Node& right = nodes[element + 1];
  return {left.displacement, left.slope_after, right.displacement, right.slope_before};
}

std::pair<std::size_t, double> HermiteNodes::element_at(double x) const {
  constexpr double at_node = 1e-9;  // distance in units of an element's length
  double left = 0.0;
  std::size_t e = 0;
  for (; e + 1 < n_elements() && x >= left + (1.0 - at_node) * lengths[e]; ++e) {
    left += lengths[e];
  }
  const double z = (x - left) / lengths[e];
  return {e, z < at_node ? 0.0 : z > 1.0 - at_node ? 1.0 : z};
}

}  // namespace subimpact
