#pragma once

#include "io/records/record.h"
#include "subimpact/simulate/answers.h"

namespace subimpact {

/// What summary.json has of an answer, and of a verdict; written, and never read back.
const Record<Answer>& answer_record();
const Record<StrikeVerdict>& verdict_record();

}  // namespace subimpact
