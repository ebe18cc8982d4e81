#pragma once

#include <optional>

#include "subimpact/case/case.h"
#include "subimpact/simulate/simulate.h"

namespace subimpact {

/// The parts that a case stands for: mesh, contact law, section. Throws InvalidCase where mesh and
/// scene do not go together.
Problem problem_of(const Case& input);

/// Checks a case and makes the parts of its run: resolve(case).settings() is what would be
/// modelled, and simulate(resolve(case)) is simulate(case). Throws InvalidCase.
ResolvedRun resolve(const Case& input);

/// Runs a case. Throws InvalidCase; any other failure is reported in the outcome. Thread-safe (see
/// simulate(ResolvedRun)).
Result simulate(const Case& input, const Progress& progress = {}, Observer* observer = nullptr,
                RowSink* rows = nullptr);
/// The same, with an observer alone.
inline Result simulate(const Case& input, Observer& observer) {
  return simulate(input, {}, &observer);
}

}  // namespace subimpact
