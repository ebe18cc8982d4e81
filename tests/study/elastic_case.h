#pragma once

#include "paper_scene.h"
#include "subimpact/case/case.h"

namespace subimpact {

/// The paper's strike on a beam that stays elastic.
inline Case elastic_case(double end_time) {
  Case input;
  input.scene = paper_scene();
  input.model.section = SectionKind::elastic;
  input.end_time = end_time;
  return input;
}

}  // namespace subimpact
