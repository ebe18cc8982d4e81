// A mass glued to the middle of a free beam: frequencies of beam and striker while in touch.

#include <fmt/format.h>

#include <cmath>

#include "model/mesh/cell_mesh.h"
#include "outcome.h"

namespace subimpact::validation {
namespace {

// Roots z = k l/2 of 1/m = omega^2 sum phi_n(s)^2/(omega_n^2 - omega^2): the mass is accelerated by
// the force that it exerts on the beam's own modes.
std::vector<double> roots(const Case& input, std::size_t n_cells, std::size_t n_roots) {
  const Beam& beam = input.scene.beam;
  const double mass = input.scene.striker.mass;
  const CellMesh mesh(beam, 0.5, n_cells, CellMesh::Extent::half);
  const NaturalModes modes = mesh.natural_modes(beam.bending_stiffness());
  std::vector<double> share(modes.size());
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const double at = mesh.struck_point()(modes.shape(k));
    share[k] = at * at;
  }
  const auto condition = [&](double omega) {
    double sum = 1.0 / mass;
    for (std::size_t k = 0; k < modes.size(); ++k) {
      const double own = modes.frequencies[k];
      sum -= omega * omega * share[k] / (own * own - omega * omega);
    }
    return sum;
  };
  std::vector<double> found;
  // One root below each elastic symmetric mode, above the one before; the sum falls in between.
  for (std::size_t k = 1; k <= n_roots; ++k) {
    double low = modes.frequencies[k - 1] * (1.0 + 1e-12) + 1e-9;
    double high = modes.frequencies[k] * (1.0 - 1e-12);
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      (condition(middle) > 0.0 ? low : high) = middle;
    }
    const double wave_number =
        std::sqrt(low) * std::pow(beam.mass_per_length() / beam.bending_stiffness(), 0.25);
    found.push_back(0.5 * wave_number * beam.length);
  }
  return found;
}

}  // namespace

Outcome check_glued_mass() {
  const Case input = case_of("glued_mass");
  Outcome outcome{"closed form", {}, {}};
  outcome.rows.push_back({"mass ratio μ", 0.889164,
                          input.scene.striker.mass / input.scene.beam.mass(), Bound::absolute,
                          0.6e-6});
  const double published[] = {2.06733243, 4.88530895, 7.97751407};
  const std::vector<double> coarse = roots(input, 251, 3);
  const std::vector<double> middle = roots(input, 501, 3);
  const std::vector<double> fine = roots(input, 1001, 3);
  for (std::size_t k = 0; k < 3; ++k) {
    const double ratio = 1001.0 / 501.0;
    const double limit = fine[k] + (fine[k] - middle[k]) / (ratio * ratio - 1.0);
    outcome.rows.push_back({fmt::format("z_{} (extrapolated from 501 and 1001 cells)", k + 1),
                            published[k], limit, Bound::relative, 1e-7});
    const double order =
        std::log((coarse[k] - published[k]) / (fine[k] - published[k])) / std::log(1001.0 / 251.0);
    outcome.rows.push_back(
        {fmt::format("z_{}, order of the cells", k + 1), 2.0, order, Bound::absolute, 0.2});
  }
  return outcome;
}

}  // namespace subimpact::validation
