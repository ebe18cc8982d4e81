#pragma once

#include <set>
#include <string>
#include <vector>

#include "subimpact/case/case.h"

namespace subimpact {

/// The keys that a user gave, by where.
struct GivenKeys {
  std::set<std::string> in_file;
  std::set<std::string> in_settings;  ///< of the command line, which go before the file
};

/// Keys that were given but that change nothing, because another key says so: a sentence each, such
/// as 'model.layers = 40 has no effect with model.section = "exact"'. None for a key of the file
/// that is idle because of a setting: the file is often run with other choices.
std::vector<std::string> keys_without_effect(const Case& input, const GivenKeys& given);

}  // namespace subimpact
