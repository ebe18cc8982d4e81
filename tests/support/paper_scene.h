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

inline Beam paper_beam() { return paper_scene().beam; }

}  // namespace subimpact
