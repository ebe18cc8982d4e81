#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "subimpact/case/case.h"
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

/// Called now and then with the simulated time, s; for progress displays. Returning false stops the
/// run, which then ends as it does at its end time but with the outcome `stopped`.
using Progress = std::function<bool(double time)>;

/// What would be modelled: everything derived from the case, nothing run. Throws InvalidCase.
Used explain(const Case& input);

/// Runs a case. Throws InvalidCase; any other failure is reported in the outcome, with all results
/// up to it.
Result simulate(const Case& input, const Progress& progress = {});

}  // namespace subimpact
