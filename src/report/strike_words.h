#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// A description of a strike in sentences: sub-impacts and zones, first yields, what the striker
/// lost, and compression and recovery in terms of the beam's elastic energy. One paragraph per
/// entry.
std::vector<std::string> strike_words(const Case& input, const Result& result);

/// Indices of the sub-impacts after the first in which the contact yielded further.
std::vector<std::size_t> yielding_again(const Result& result);

}  // namespace subimpact
