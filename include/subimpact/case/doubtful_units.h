#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// Values that are probably given in another unit than that of the case file, such as lengths in mm
/// or stresses in MPa: one sentence per key, with the value, what makes it doubtful and what to
/// write if that unit was meant. Empty for every plausible scene; a doubtful one can still be run.
std::vector<std::string> doubtful_units(const Case& input);
/// The sentence about the number of one key; empty if its unit is not doubtful.
std::string doubtful_unit(const Case& input, std::string_view key);

/// A warning: what it is about, in a word, and the sentence.
struct Beyond {
  std::string_view kind;
  std::string sentence;
};
/// Results of a run that exceed the validity of the model (docs/model.md), one sentence each with
/// the number and what to do; empty if there are none. Rotations are sampled at separations and at
/// the end of the run.
std::vector<Beyond> beyond_the_model(const Case& input, const Result& result);

}  // namespace subimpact
