#pragma once

#include <string>
#include <vector>

#include "random_scenes/run.h"

namespace subimpact::scenes {

/// The outcome as Markdown: outcomes by method and rtol, what did not hold, counts.
std::string outcome_tables(const std::vector<Record>& records);

/// Every scene of which a check failed, with the command that writes its case file.
std::string failure_list(const std::vector<Record>& records);

/// All scenes as CSV.
std::string csv(const std::vector<Record>& records);

/// Of runs at rtol 1e-6 or tighter by methods that have to complete: how many did.
struct Completed {
  int n = 0, completed = 0, left_validity = 0, wall_clock = 0;
  double percent() const { return n > 0 ? 100.0 * completed / n : 100.0; }
};
Completed completed_where_due(const std::vector<Record>& records, const std::string& method);

/// Whether everything holds that the study asks for.
bool all_hold(const std::vector<Record>& records);

}  // namespace subimpact::scenes
