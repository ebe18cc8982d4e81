#pragma once

#include <string>

#include "subimpact/report/text.h"

namespace subimpact {

/// What struck what: "0.201 kg at 15.9 m/s (cylindrical nose of 10 mm) on the middle of ...".
std::string strike_words(const Case& input, const Result& result);

}  // namespace subimpact
