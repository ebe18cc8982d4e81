#pragma once

#include "io/records/record.h"
#include "subimpact/io/results.h"

namespace subimpact {

/// What summary.json describes.
struct DescribedRun {
  const Case* input;
  const Result* result;
};

const Record<DescribedRun>& run_record();

/// A part of the errors of the body: its name in files, in words, and what makes it smaller, or why
/// nothing does.
struct BodyPartWords {
  BodyPart kind;
  const char *name, *label, *remedy;
};
std::span<const BodyPartWords> names_of(BodyPart);

/// What summary.json has of errors of the body.
const Record<BodyErrors>& body_record();

/// What it has of an answer, and of a verdict; written, and never read back.
const Record<Answer>& answer_record();
const Record<StrikeVerdict>& verdict_record();

}  // namespace subimpact
