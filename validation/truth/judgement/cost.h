#pragma once

#include <string>
#include <vector>

namespace subimpact::judgement {

/// Prints what case files and three elastic scenes cost: the run that the program chooses by
/// itself, over the same run alone, and all runs of the choice.
void study_cost(const std::vector<std::string>& files);

}  // namespace subimpact::judgement
