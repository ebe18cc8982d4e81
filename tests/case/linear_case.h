#pragma once

#include "paper_case.h"

namespace subimpact {

inline constexpr double third = 1.0 / 3.0;

/// The published beam, elastic, under a linear spring: `n` cells or elements.
inline Case linear_case(MeshKind mesh, int n, double position, EndSupport end) {
  Case input = paper_case(SectionKind::elastic, 0.5e-3);
  input.scene.contact = {ContactKind::linear, 2e6, {}, {}, {}};
  input.scene.striker.position = position;
  input.scene.beam.ends = {end, end};
  input.model.mesh = mesh;
  (mesh == MeshKind::cells ? input.model.segments : input.model.elements) = n;
  input.solver.method = Method::nystrom;
  input.solver.rtol = 1e-11;
  return input;
}

}  // namespace subimpact
