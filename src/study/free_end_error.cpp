#include "study/free_end_error.h"

#include <algorithm>
#include <cmath>

#include "study/error_part.h"

namespace subimpact {

double free_end_error(const Case& input, double contact_time, double time) {
  const Beam& beam = input.scene.beam;
  const bool cells = input.model.mesh == MeshKind::cells && !input.parts.mesh;
  if (!cells || beam.theory != BeamTheory::rayleigh) return 0.0;
  const auto n_free = std::count(beam.ends.begin(), beam.ends.end(), EndSupport::free);
  const double speed = std::sqrt(beam.youngs_modulus / beam.density);
  const double y2 = std::pow(beam.radius_of_gyration() / (speed * contact_time), 2);
  const double x = 0.5 * (y2 + std::sqrt(y2 * (y2 + 4.0)));
  return time * static_cast<double>(n_free) / input.model.segments * x / (1.0 + x);
}

void include_free_ends(ErrorPart& part, const Case& input, const Result& result) {
  for (std::size_t i = 0; i < part.errors.size(); ++i) {
    const SubImpact& s = result.sub_impacts[i];
    const double error = free_end_error(input, result.used.contact_time, s.end.value_or(s.start));
    part.errors[i] = std::max(part.errors[i], error);
  }
}

}  // namespace subimpact
