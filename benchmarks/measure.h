#pragma once

#include <functional>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/case/simulate.h"

namespace subimpact::benchmarks {

/// Which clock times are taken with. On a busy machine wall time counts what others do.
enum class Clock { processor, wall };

struct Settings {
  int repeats = 5;
  Clock clock = Clock::processor;
};

/// Seconds each contestant needs: the median of `settings.repeats` rounds, in each of which all of
/// them run once, one after the other, so that what slows the machine for a while slows all alike.
/// One more round before them is not counted.
std::vector<double> seconds_side_by_side(const Settings& settings,
                                         const std::vector<std::function<void()>>& contestants);

/// The paper's example: mass 0.201 kg at 15.9 m/s on a free-free beam of 501 cells, up to 2 ms,
/// without history rows.
Case paper_case(SectionKind section);
/// The same with shear, struck by the cylinder as Hertz's line contact with a yield pressure by
/// depth.
Case paper_case_with_shear(SectionKind section);

/// simulate(), for a case that must run to its end. Throws std::runtime_error with the outcome if
/// not.
Result run_to_end(const Case& input);

/// End of the last sub-impact that ended, s.
double last_separation(const Result& result);

}  // namespace subimpact::benchmarks
