#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "subimpact/case/case.h"
#include "subimpact/simulate/observer.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// A case that cannot be run as asked. `key` is the case file's ("solver.step"); `what()` says what
/// is wrong, what is allowed and what to do.
class InvalidCase : public std::runtime_error {
 public:
  InvalidCase(std::string key, const std::string& message)
      : std::runtime_error(message), key(std::move(key)) {}
  std::string key;
};

/// What would be modelled: everything derived from the case, nothing run. Throws InvalidCase.
Used explain(const Case& input);

/// Runs a case. Throws InvalidCase; any other failure is reported in the outcome, with all results
/// up to it. `observer`, if any, is shown every accepted step and event.
///
/// Thread-safe: runs in several threads at once share nothing, and each gives the results, bit for
/// bit, that it gives alone. Laws in `input.parts` that several runs share are called from all of
/// them, so their functions must be pure; observers and progress functions are called in the thread
/// of their own run.
Result simulate(const Case& input, const Progress& progress = {}, Observer* observer = nullptr);
/// The same, with an observer alone.
inline Result simulate(const Case& input, Observer& observer) {
  return simulate(input, {}, &observer);
}

}  // namespace subimpact
