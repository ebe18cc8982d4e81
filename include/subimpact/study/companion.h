#pragma once

#include <optional>

#include "subimpact/case/simulate.h"
#include "subimpact/study/error_bars.h"

namespace subimpact {

/// The companion of a case: a run of the same scene that is coarser in mesh and time together, so
/// that one comparison shows the error of both at a quarter of the cost. Half as many cells or
/// elements; of a fixed step the default of that mesh or, where the contact limits the step, twice
/// the case's; ten times rtol. Where the mesh cannot be coarser (a rigid beam, a mesh of the
/// caller's own), only time is. Nothing where the program cannot make a coarser run.
///
/// With h the size of the cells or elements and p the order of the mesh, a difference d between the
/// run and its companion stands for an error of the run of d/(2^p - 1). Stated is 2.1 times that, 5
/// times where p = 4, 3 times where sections of cells yield and 4 times where those of elements do,
/// and at least what free ends leave.
struct Companion {
  Case input;
  std::string name;         ///< what it is coarser in: "mesh and time", "time"
  std::string description;  ///< in words
  double ratio = 1.0;       ///< sizes of its cells or elements over those of the case
};
std::optional<Companion> companion_of(const Case& input);

/// Bytes that a run with these settings and the companion of its case take beside one another,
/// roughly.
double memory_with_companion(const Case& input, const ResolvedSettings& settings);

/// Fills the errors and the error estimate of a result from the run of its companion. Elements of
/// which no section has yielded converge at the order of an elastic beam.
void add_companion_errors(Result& result, const Case& input, const Companion& companion,
                          const Result& other);

/// Threads that a function may use for runs beside one another; results do not depend on it.
using Jobs = unsigned;

/// Runs a case and its companion, and gives every sub-impact's start and end an estimated error:
/// the factor of the companion times the largest difference between the two runs over the event and
/// its neighbours. Result::error_estimate names the first sub-impact whose existence or order is
/// not certain. Without a companion the estimate is missing. `progress` follows the case's own run;
/// `rows`, if any, takes the rows of that run. Throws InvalidCase.
Result simulate_with_companion(const Case& input, Jobs jobs, const Progress& progress = {},
                               RowSink* rows = nullptr);

}  // namespace subimpact
