#include "model/element_grading.h"

#include <cmath>

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

}  // namespace subimpact
