#pragma once

/// What to run after a run.

#include <string>
#include <utility>
#include <vector>

#include "subimpact/case/case_keys.h"
#include "subimpact/case/simulate.h"

namespace subimpact {

/// A further run that answers what this one leaves open.
struct Advice {
  /// Options of `subimpact run` and their values: {"--within", "1us"}, {"--set", "time.end=0.016"}.
  std::vector<std::pair<std::string, std::string>> options;
  double seconds = 0.0;  ///< expected, by the time and the counted work of this run
  std::string gain;      ///< "shows whether contact is over"
};

/// Whether shear moves the end of the first contact by half a per cent or more.
bool is_notable(const NeglectedShear& shear);

/// The most useful first. `input` and `given`: the case as it was run, and the keys that the user
/// gave. Whether a case takes the options is not checked.
std::vector<Advice> advice(const Case& input, const GivenKeys& given, const Result& result);

}  // namespace subimpact
