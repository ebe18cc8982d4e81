#include "study/free_end_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/error_part.h"

namespace subimpact {

namespace {

// Of the strike, m; infinite without a free end.
double distance_to_free_end(const Scene& scene) {
  double nearest = std::numeric_limits<double>::infinity();
  const double at = scene.striker.position;
  if (scene.beam.ends[0] == EndSupport::free) nearest = at * scene.beam.length;
  if (scene.beam.ends[1] == EndSupport::free) {
    nearest = std::min(nearest, (1.0 - at) * scene.beam.length);
  }
  return nearest;
}

}  // namespace

double free_end_error(const Case& input, double contact_time, double time) {
  const Beam& beam = input.scene.beam;
  const bool cells = input.model.mesh == MeshKind::cells && !input.parts.mesh;
  if (!cells || beam.theory != BeamTheory::rayleigh) return 0.0;
  const auto n_free = std::count(beam.ends.begin(), beam.ends.end(), EndSupport::free);
  if (n_free == 0) return 0.0;
  const double speed = std::sqrt(beam.youngs_modulus / beam.density);
  const double y2 = std::pow(beam.radius_of_gyration() / (speed * contact_time), 2);
  const double x = 0.5 * (y2 + std::sqrt(y2 * (y2 + 4.0)));
  const double stretch = 1.0 + x;
  const double group_velocity = speed * std::sqrt(x) * (2.0 + x) / (stretch * std::sqrt(stretch));
  const double round_trip = 2.0 * beam.length / group_velocity;
  const double nearest = distance_to_free_end(input.scene);
  const double reflected =
      std::min(static_cast<double>(n_free) * time + round_trip, time * beam.length / nearest);
  return reflected / input.model.segments * x / stretch;
}

void include_free_ends(ErrorPart& part, const Case& input, const Result& result) {
  for (std::size_t i = 0; i < part.errors.size(); ++i) {
    const SubImpact& s = result.sub_impacts[i];
    const double since_touch = s.end.value_or(s.start) - input.scene.striker.first_touch();
    const double error = free_end_error(input, result.used.contact_time, since_touch);
    part.errors[i] = std::max(part.errors[i], error);
  }
}

}  // namespace subimpact
