#pragma once

#include <string>
#include <vector>

#include "subimpact/study/stability.h"

namespace subimpact {

// Scripts for draw_figure, one a part of a stability study.
std::string critical_step_figure(const std::vector<CriticalStep>& rows);
std::string stiff_contact_figure(const std::vector<StiffContact>& rows);
std::string damping_figure(const std::vector<Damping>& rows,
                           const std::vector<MultistepGrowth>& growths);
std::string outcome_figure(const OutcomeMap& map);
std::string missed_pairs_figure(const std::vector<MissedPairs>& rows);
std::string layer_figure(const LayerStudy& study);

}  // namespace subimpact
