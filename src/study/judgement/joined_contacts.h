#pragma once

#include <optional>
#include <span>

#include "subimpact/study/judgement/judgement.h"

namespace subimpact {

/// How many sub-impacts of a judged run would be certain if those parted by less than 1 um were
/// joined; none if few are uncertain or contacts are joined already.
std::optional<ErrorEstimate::Joined> judge_joined(const Case& input, const Result& run,
                                                  std::span<const RunBeside> beside);

}  // namespace subimpact
