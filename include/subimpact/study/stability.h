#pragma once

/// Where and how runs of a case fail, by method and by setting. Nothing is compared by time, so
/// `jobs` runs go at a time (0: one for each processor).

#include <functional>
#include <string>
#include <vector>

#include "subimpact/case/simulate.h"
#include "subimpact/study/judgement/event_errors.h"

namespace subimpact {

/// Whether a list of methods includes this one: a name without a table stands for all its tables,
/// an empty list for all methods.
bool asked_for(const std::vector<std::string>& methods, const std::string& method);

struct OutcomePoint : Trial {
  std::string row;  ///< method, and what else sets the row apart
  double x = 0.0;   ///< omega_max h of a fixed step, or rtol
};

struct OutcomeMap {
  Reference reference;
  std::vector<OutcomePoint> points;
};

/// Methods against fixed steps, from far below to far beyond the stable ones, and against
/// tolerances; backward differentiation order by order; implicit methods with steps at which high
/// modes are damped away. A run that takes more than `run_seconds` by the clock is left out.
/// `progress` is called with the numbers of finished and of all runs; false: no more begin, and the
/// result holds those that have ended.
using Count = std::function<bool(std::size_t done, std::size_t all)>;
OutcomeMap outcome_map(const Case& input, const std::vector<std::string>& methods = {},
                       double run_seconds = 20.0, Jobs jobs = 0, const Count& progress = {});

}  // namespace subimpact
