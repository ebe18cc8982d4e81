#pragma once

#include "io/records/record.h"
#include "subimpact/simulate/answers.h"

namespace subimpact {

std::span<const Named<BodyPart>> names_of(BodyPart);
/// What summary.json has of errors of the body.
const Record<BodyErrors>& body_record();

/// What it has of an answer, and of a verdict; written, and never read back.
const Record<Answer>& answer_record();
const Record<StrikeVerdict>& verdict_record();

}  // namespace subimpact
