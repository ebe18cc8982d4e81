#pragma once

/// What must hold of any result, recomputed where the result allows it.

#include <string>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact::scenes {

struct Failure {
  std::string check;   ///< a few words, the same for all scenes
  std::string detail;  ///< with numbers
};

/// Everything that is wrong with a result. Of each check the first failure alone.
std::vector<Failure> failures_of(const Case& input, const Result& result);

/// Whether the case, written as a case file and read again, is the same to the last bit.
std::vector<Failure> failures_of_file(const Case& input);

}  // namespace subimpact::scenes
