#pragma once

#include "paper_scene.h"
#include "subimpact/case/case.h"

namespace subimpact {

/// The paper's bodies, both rigid, under a contact law; the foundation keeps its nose.
inline Case rigid_case(ContactKind kind, double velocity, double end_time) {
  Case input;
  input.scene = paper_scene();
  input.scene.contact.kind = kind;
  input.scene.striker.velocity = velocity;
  if (kind == ContactKind::hertz || kind == ContactKind::linear) {
    input.scene.striker.nose_radius.reset();
    input.scene.contact.stiffness = kind == ContactKind::hertz ? 3e10 : 2e7;
  }
  input.model.mesh = MeshKind::rigid;
  input.end_time = end_time;
  return input;
}

/// m M/(m + M)
inline double reduced_mass(const Case& input) {
  const double m = input.scene.striker.mass, beam = input.scene.beam.mass();
  return m * beam / (m + beam);
}

}  // namespace subimpact
