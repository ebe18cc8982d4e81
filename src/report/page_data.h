#pragma once

#include <string>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// What the scripts of a page draw, and what was left out to keep the page small.
struct PageData {
  std::string json;          ///< to stand within a script element: without <, > and &
  std::string history_note;  ///< one sentence; empty if every row is there
  std::string shapes_note;   ///< one or two sentences
};

/// The data of a run. Columns are packed (see page.h): a value is exact to 6e-8 of itself (f32) or
/// of the largest of its column (i24). Of long histories the rows with the extremes of equal spans
/// are kept, of many or fine shapes those at events and every n-th.
PageData page_data(const Case& input, const Result& result);

/// The data of several runs for a page that compares them: named columns of their histories.
std::string comparison_data(const std::vector<std::string>& names,
                            const std::vector<const Result*>& results);

}  // namespace subimpact
