#pragma once

#include <string>
#include <vector>

#include "subimpact/simulate/result.h"

namespace subimpact {

/// The sub-impacts of a run as people read them: microseconds, newtons, millimetres, with the
/// digits that their errors allow; without an error estimate, with a fixed number of digits. A time
/// has its error beside it, and a duration is rounded to the sum of the errors of start and end.
/// Sub-impacts that are not certain have a question mark and three digits of the run that is shown,
/// times as many as its duration needs.
struct SubImpactRows {
  struct Column {
    const char* name;
    const char* unit;
    std::size_t width = 0;  ///< in characters, at least that of its cells
  };
  std::vector<Column> columns;
  struct Row {
    bool is_certain = true;          ///< also where no error estimate exists
    std::vector<std::string> cells;  ///< one per column, decimal points under each other
  };
  std::vector<Row> rows;
};

/// `plus_minus`: what stands between a time and its error.
SubImpactRows sub_impact_rows(const Result& result, const char* plus_minus = "+-");

/// A total of the run with its error: "8796.3 +- 0.8 N"; without an error estimate so many
/// decimals. `name`: as in summary.json; `factor`: from SI to `unit`.
std::string total_text(const Result& result, const char* name, double value, double factor,
                       int decimals, const char* unit);

/// Where something is not certain: "sub-impact 3", or the flight before it: "after sub-impact 2",
/// "after the last sub-impact". `first_unresolved`, `reason`: of the error estimate or of a part.
std::string place_of_doubt(const Result& result, std::size_t first_unresolved,
                           const std::string& reason);

}  // namespace subimpact
