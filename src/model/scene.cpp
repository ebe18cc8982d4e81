#include "subimpact/model/scene.h"

#include <cmath>

namespace subimpact {

double Beam::radius_of_gyration() const { return std::sqrt(second_moment() / area()); }

}  // namespace subimpact
