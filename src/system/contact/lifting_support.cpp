#include "system/contact/lifting_support.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>

#include "model/contact/power_contact.h"

namespace subimpact {
namespace {

// Far above the rounding of displacements, far below those that make a force to speak of.
constexpr double dead_share = 1e-12;

}  // namespace

std::size_t LiftingSupport::half_bandwidth() const {
  const auto [low, high] =
      std::ranges::minmax(approach.terms, {}, &SparseFunctional::Term::unknown);
  return high.unknown - low.unknown;
}

std::vector<LiftingSupport> lifting_supports(const BeamMesh& mesh, const Beam& beam,
                                             double length_scale) {
  std::vector<LiftingSupport> all;
  for (std::size_t i = 0; i < beam.springs.size(); ++i) {
    const auto& [position, stiffness, one_sided] = beam.springs[i];
    if (!one_sided || (mesh.symmetric() && position > 0.5)) continue;
    const double x = position * beam.length;
    const std::optional<SparseFunctional> at = mesh.displacement_at(x);
    if (!at || !at->dense.empty()) {
      throw std::invalid_argument("a support that lifts: a mesh without displacement_at()");
    }
    if (at->is_zero()) continue;  // on a support that holds
    const double sense = one_sided->side == SpringSide::behind ? 1.0 : -1.0;
    SparseFunctional approach;
    approach.add(sense, *at);
    constexpr double never = std::numeric_limits<double>::infinity();
    all.push_back(
        {i, x, sense, one_sided->gap, mesh.symmetric() && position < 0.5 ? 2.0 : 1.0,
         std::move(approach),
         ContactState(std::make_shared<PowerContact>(stiffness, 1.0, never), one_sided->damping),
         dead_share * length_scale});
  }
  return all;
}

}  // namespace subimpact
