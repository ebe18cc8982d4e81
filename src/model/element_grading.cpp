#include "model/element_grading.h"

#include <cmath>

namespace subimpact {

double ElementGrading::elements_within(double d) const {
  if (refinement == 1.0) return d;
  const double growth = (1.0 - 1.0 / refinement) / reach;  // of the size, a metre
  if (d <= reach) return std::log1p(growth * refinement * d) / growth;
  return std::log(refinement) / growth + (d - reach);
}

double ElementGrading::distance_of(double elements) const {
  if (refinement == 1.0) return elements;
  const double growth = (1.0 - 1.0 / refinement) / reach;
  const double within_reach = std::log(refinement) / growth;
  if (elements <= within_reach) return std::expm1(growth * elements) / (growth * refinement);
  return reach + (elements - within_reach);
}

}  // namespace subimpact
