#include "system/readings/rigid_motion.h"

#include <cmath>

#include "numerics/lanes.h"

namespace subimpact {
namespace {

constexpr double rounding = 1e-6;  // of meshes that can move as a rigid body

// Whether the beam can turn about its one pinned end.
bool is_pendulum(const Beam& beam) {
  const auto [first, last] = beam.ends;
  return (first == EndSupport::free && last == EndSupport::pinned) ||
         (first == EndSupport::pinned && last == EndSupport::free);
}

}  // namespace

std::vector<double> rigid_motion_at_struck_point(const StruckBeam& struck_beam, const Beam& beam,
                                                 double position) {
  const BeamMesh& mesh = struck_beam.mesh();
  const bool flies = beam.is_free() && (!beam.is_sprung() || struck_beam.has_stop());
  const bool turns = is_pendulum(beam) && !beam.is_sprung();
  if (beam.fixed || !(flies || turns || struck_beam.has_stop())) return {};
  const std::size_t n = mesh.n_unknowns();
  const auto momentum = mesh.momentum_functional(), moment = mesh.moment_functional();
  std::vector<double> sum(n, 0.0);
  if (!turns) {
    for (std::size_t i = 0; i < n; ++i) sum[i] = momentum[i] / mesh.beam_mass();
  }
  const double pivot = !turns ? 0.5 : beam.ends[0] == EndSupport::pinned ? 0.0 : 1.0;
  const double lever = beam.length * (position - pivot);
  if (!(flies || turns) || moment.empty() || lever == 0.0) return sum;
  // With the moment of momentum h.v about the pivot, M r = h is solved by a rotation r.
  std::vector<double> about_pivot(n);
  for (std::size_t i = 0; i < n; ++i) {
    about_pivot[i] = moment[i] - pivot * beam.length * momentum[i];
  }
  std::vector<double> rotation = about_pivot;
  struck_beam.mass_solver().solve(rotation);
  const double of_point = mesh.struck_point()(rotation);
  if (!(std::abs(of_point - lever) <= rounding * beam.length)) return sum;
  const double inertia = dot(about_pivot.data(), rotation.data(), n);
  for (std::size_t i = 0; i < n; ++i) sum[i] += lever / inertia * about_pivot[i];
  return sum;
}

}  // namespace subimpact
