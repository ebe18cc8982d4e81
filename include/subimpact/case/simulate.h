#pragma once

#include "subimpact/case/case.h"
#include "subimpact/simulate/simulate.h"

namespace subimpact {

/// The parts that a case describes: mesh, contact law, section. Throws InvalidCase if mesh and
/// scene do not fit each other.
Problem problem_of(const Case& input);

/// Checks a case and makes the parts of its run: resolve(case).settings() are the settings of that
/// run, and simulate(resolve(case)) is simulate(case). Throws InvalidCase.
ResolvedRun resolve(const Case& input);

/// Runs a case. Throws InvalidCase; any other failure is reported in the outcome. Thread-safe (see
/// simulate(ResolvedRun)).
Result simulate(const Case& input, const Progress& progress = {}, Observer* observer = nullptr,
                RowSink* rows = nullptr);
/// simulate() with an observer only.
inline Result simulate(const Case& input, Observer& observer) {
  return simulate(input, {}, &observer);
}

}  // namespace subimpact
