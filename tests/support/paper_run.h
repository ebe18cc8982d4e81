#pragma once

#include "paper_scene.h"
#include "subimpact/case/case.h"

namespace subimpact {

/// The paper's example on cells, without rows.
inline Case paper_run(SectionKind section, double end_time, int segments = 501,
                      Method method = Method::erk) {
  Case input;
  input.scene = paper_scene();
  input.model.section = section;
  input.model.segments = segments;
  input.end_time = end_time;
  input.solver.method = method;
  input.output.interval = 0.0;
  return input;
}

}  // namespace subimpact
