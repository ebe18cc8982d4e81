#pragma once

#include "subimpact/model/scene.h"

namespace subimpact {

/// The struck-beam paper's example.
inline Scene paper_scene() {
  Scene scene;
  scene.beam.length = 0.7112;
  scene.beam.width = 0.0163;
  scene.beam.thickness = 0.0075;
  scene.beam.density = 2600.0;
  scene.beam.youngs_modulus = 71.96e9;
  scene.beam.yield_stress = 150e6;
  scene.striker.mass = 0.201;
  scene.striker.nose_radius = 0.01;
  scene.striker.velocity = 15.9;
  scene.striker.position = 0.5;
  return scene;
}

using Ends = std::array<EndSupport, 2>;
inline constexpr EndSupport free_end = EndSupport::free;
inline constexpr EndSupport pinned = EndSupport::pinned;
inline constexpr EndSupport clamped = EndSupport::clamped;
inline constexpr EndSupport all_ends[] = {free_end, pinned, clamped};
inline constexpr Ends free_ends = {free_end, free_end};

inline Beam paper_beam(BeamTheory theory = BeamTheory::rayleigh, Ends ends = free_ends) {
  Beam beam = paper_scene().beam;
  beam.theory = theory;
  beam.ends = ends;
  return beam;
}

}  // namespace subimpact
