#pragma once

#include <optional>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// The answers of a run in the order of the screen, without words: one of each AnswerKey. Those
/// that are not there have no value and say why. Errors are those of Result::error_estimate and
/// Result::body_errors; none where these have none.
std::vector<Answer> answers_of(const Case& input, const Result& result);

/// The verdict on a run, without words.
StrikeVerdict verdict_of(const Result& result);

/// The answer of that key; throws std::out_of_range where there is none.
const Answer& answer_of(const std::vector<Answer>& answers, AnswerKey key);

/// The error of a total; none where it is not known.
std::optional<double> error_of_total(const Result& result, RunTotal name);

/// The flight after the last sub-impact, if it may hold another one; else null.
const ErrorEstimate::UncertainFlight* doubt_after_last(const Result& result);

}  // namespace subimpact
