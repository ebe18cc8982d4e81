#pragma once

#include "paper_run.h"

namespace subimpact {

/// The paper's strike on a beam that stays elastic.
inline Case elastic_case(double end_time, int segments = 501, Method method = Method::erk) {
  Case input = paper_run(SectionKind::elastic, end_time, segments, method);
  input.output.interval.reset();
  return input;
}

}  // namespace subimpact
