#include "system/deformation.h"

#include <algorithm>
#include <cmath>

namespace subimpact {
namespace {

constexpr int n_stations = 17;  // both ends of the part modelled among them

}  // namespace

Deformation::Deformation(const StruckBeam& beam, double length) : beam_(beam) {
  const double end = beam.mesh().symmetric() ? 0.5 * length : length;
  for (int i = 0; i < n_stations; ++i) {
    const auto rotation = beam.mesh().rotation_at(end * i / (n_stations - 1));
    if (rotation) rotations_.push_back(*rotation);
  }
}

void Deformation::include(const State& y) {
  const auto unknowns = beam_.beam_positions(y);
  for (const SparseFunctional& rotation : rotations_) {
    largest_rotation_ = std::max(largest_rotation_, std::abs(rotation(unknowns)));
  }
  include_displacement(beam_.mesh().struck_point()(unknowns));
}

void Deformation::include_displacement(double of_struck_point) {
  largest_displacement_ = std::max(largest_displacement_, std::abs(of_struck_point));
}

}  // namespace subimpact
