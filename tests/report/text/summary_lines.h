#pragma once

#include <string>

#include "subimpact/report/text.h"
#include "subimpact/study/answers.h"
#include "unwrapped.h"

namespace subimpact {

inline Result answered(const Case& input, Result result) {
  make_answers(input, result);
  return result;
}

inline std::string summary_of(const Case& input, const Result& result, bool verbose = false) {
  return unwrapped(run_summary(input, answered(input, result), verbose));
}

inline Answer answer_to(const Case& input, const Result& result, AnswerKey key) {
  return answer_of(answered(input, result).answers, key);
}

/// The line of a summary with that label.
inline std::string line_of(const std::string& summary, const std::string& label) {
  const auto begin = summary.find("\n  " + label);
  if (begin == std::string::npos) return {};
  return summary.substr(begin + 1, summary.find('\n', begin + 1) - begin - 1);
}

}  // namespace subimpact
