#pragma once

#include <string>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// A description of a strike in sentences: sub-impacts and zones, first yields, what the striker
/// lost, and compression and recovery in terms of the beam's elastic energy. One paragraph per
/// entry.
std::vector<std::string> strike_words(const Case& input, const Result& result);

}  // namespace subimpact
