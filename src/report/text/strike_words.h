#pragma once

#include <string>
#include <utility>
#include <vector>

#include "subimpact/report/text.h"

namespace subimpact {

/// What struck what: "0.201 kg at 15.9 m/s (cylindrical nose of 10 mm) on the middle of ...".
std::string strike_words(const Case& input, const Result& result);

/// What a beam does on supports that it can lift off, one label and its words for each: "support at
/// 0", "lifts at 142.1 +- 0.1 us, back at 1310 us; 3 times". Contacts of less than a thousandth of
/// the largest force of all supports are left out; empty without such supports.
std::vector<std::pair<std::string, std::string>> support_words(const Case& input,
                                                               const Result& result);

}  // namespace subimpact
